// The ranks of a vtkMultiProcessController.

#ifndef ControllerCommunicator_h
#define ControllerCommunicator_h

#include "Agreement.h"
#include "Communicator.h"

#include "vtkSmartPointer.h"

class vtkMultiProcessController;

namespace activesurface
{

class ControllerCommunicator : public Communicator
{
public:
  explicit ControllerCommunicator(vtkMultiProcessController* controller);
  ~ControllerCommunicator() override;

  int GetRank() const override;
  int GetSize() const override;
  std::int64_t Max(std::int64_t own) override;
  std::vector<Bytes> AllGather(const Bytes& own) override;
  std::vector<Bytes> Swap(
    const std::vector<Bytes>& toEach, const std::vector<std::size_t>& sizes) override;

private:
  template <class GetOwn>
  std::vector<Bytes> SwapInPairs(GetOwn&& getOwn, const std::vector<std::size_t>& sizes);
  void Send(const Bytes& bytes, int rank);
  void Receive(Bytes& bytes, int rank);

  vtkSmartPointer<vtkMultiProcessController> Controller;
};

// Of a program of one process if the controller is null or has one only.
Agreement MakeAgreement(vtkMultiProcessController* controller);

}

#endif
