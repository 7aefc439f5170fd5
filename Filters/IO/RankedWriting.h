/**
 * Writing by several MPI ranks: rank 0 writes; success or failure is reported on all ranks.
 */
#ifndef RankedWriting_h
#define RankedWriting_h

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <exception>
#include <stdexcept>

namespace activesurface
{

/** Returns true on rank 0. Null controller: a single process. */
inline bool IsFirstRank(vtkMultiProcessController* controller)
{
  return !controller || controller->GetLocalProcessId() == 0;
}

/**
 * Collective. Runs a part of the writing on each rank. Throws on all ranks if it has failed on one
 * of them. Every rank has to call it the same number of times.
 */
template <class Task>
void RunOnAllRanks(vtkMultiProcessController* controller, Task&& task)
{
  std::exception_ptr error;
  try
  {
    task();
  }
  catch (...)
  {
    error = std::current_exception();
  }
  const int hasFailed = error ? 1 : 0;
  int hasAnyFailed = hasFailed;
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    controller->AllReduce(&hasFailed, &hasAnyFailed, 1, vtkCommunicator::MAX_OP);
  }
  if (error)
  {
    std::rethrow_exception(error);
  }
  if (hasAnyFailed)
  {
    throw std::runtime_error("Another rank has failed to write the file; its own error says why.");
  }
}

}

#endif
