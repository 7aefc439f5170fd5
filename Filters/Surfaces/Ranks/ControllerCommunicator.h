// The ranks of a vtkMultiProcessController.

#ifndef ControllerCommunicator_h
#define ControllerCommunicator_h

#include "Ranks/Agreement.h"
#include "Ranks/Communicator.h"

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

private:
  void SwapInPairs(
    const Bytes& own, const std::vector<std::size_t>& sizes, std::vector<Bytes>& fromEach);
  void Send(const Bytes& bytes, int rank);
  void Receive(Bytes& bytes, int rank);

  vtkSmartPointer<vtkMultiProcessController> Controller;
};

// Of a program of one process if the controller is null or has one only.
Agreement MakeAgreement(vtkMultiProcessController* controller);

}

#endif
