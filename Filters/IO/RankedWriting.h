/**
 * Ranks of a parallel program that write a file together: one has the pen, all know how it went.
 */
#ifndef RankedWriting_h
#define RankedWriting_h

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <exception>
#include <stdexcept>

namespace activesurface
{

/** Null: this process alone. */
inline bool IsFirstRank(vtkMultiProcessController* controller)
{
  return !controller || controller->GetLocalProcessId() == 0;
}

/**
 * Runs a part of the writing on each rank. All ranks call it as often as each other, and all throw
 * if it has failed on one of them.
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
