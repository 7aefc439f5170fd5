// Communicator of the ranks of a vtkMultiProcessController.

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
  std::vector<std::int64_t> AllGather(std::int64_t own) override;
  void AllGather(const Bytes& own, std::vector<Bytes>& all) override;
  void Swap(const std::vector<Bytes>& toEach, std::vector<Bytes>& fromEach) override;

private:
  template <class GetOwn>
  void SwapInPairs(GetOwn&& getOwn, std::vector<Bytes>& fromEach);
  void Send(const Bytes& bytes, int rank);
  void Receive(Bytes& bytes, int rank);

  vtkSmartPointer<vtkMultiProcessController> Controller;
};

// Returns the agreement of one process if the controller is null or has only one process.
Agreement MakeAgreement(vtkMultiProcessController* controller);

}

#endif
