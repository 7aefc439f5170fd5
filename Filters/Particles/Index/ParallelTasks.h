// Runs tasks on all of VTK's threads and passes exceptions to the caller. With some of VTK's
// backends, an exception that leaves a thread ends the program.

#ifndef ParallelTasks_h
#define ParallelTasks_h

#include "vtkSMPTools.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <vector>

namespace activesurface
{

// Particles in a task, for work of some microseconds per particle.
constexpr std::size_t ParticlesPerTask = 256;

// Calls task(0) to task(count - 1), each once unless a task throws. Rethrows an exception of a
// task.
template <class Task>
void RunTasks(std::size_t count, Task task)
{
  if (count == 1)
  {
    task(std::size_t(0));
    return;
  }
  std::exception_ptr error;
  std::mutex ofError;
  vtkSMPTools::For(0, static_cast<vtkIdType>(count), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      try
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          task(static_cast<std::size_t>(i));
        }
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(ofError);
        error = std::current_exception();
      }
    });
  if (error)
  {
    std::rethrow_exception(error);
  }
}

// Calls task(begin, end) for each piece of the numbers 0 to count - 1. A piece excludes `end` and
// has inPiece numbers; the last piece may have fewer.
template <class Task>
void RunPieces(std::size_t count, std::size_t inPiece, Task task)
{
  RunTasks((count + inPiece - 1) / inPiece,
    [&](std::size_t piece) { task(piece * inPiece, std::min((piece + 1) * inPiece, count)); });
}

// Returns the maximum of `least` and value(0) to value(count - 1).
template <class Number, class Value>
Number FindMost(std::size_t count, Number least, Value value)
{
  constexpr std::size_t inPiece = 4096;
  std::vector<Number> most((count + inPiece - 1) / inPiece, least);
  RunPieces(count, inPiece,
    [&](std::size_t begin, std::size_t end)
    {
      Number& here = most[begin / inPiece];
      for (std::size_t i = begin; i < end; ++i)
      {
        here = std::max(here, value(i));
      }
    });
  return most.empty() ? least : *std::max_element(most.begin(), most.end());
}

// Calls task(0) to task(count - 1) in batches, for tasks of little work.
template <class Task>
void RunEach(std::size_t count, Task task)
{
  constexpr std::size_t inPiece = 4096;
  RunPieces(count, inPiece,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        task(i);
      }
    });
}

}

#endif
