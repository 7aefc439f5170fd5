// Input data set of an implicit function: a given data set, or the output of an algorithm. The
// output is updated when the function reads it, because no pipeline updates the input of a
// function.

#ifndef FunctionInput_h
#define FunctionInput_h

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <mutex>

class vtkAlgorithmOutput;

namespace activesurface
{

class FunctionInput
{
public:
  // SetData and Connect replace any earlier input, and return true if the input has changed. The
  // function then has to call Modified().
  bool SetData(vtkDataObject* data);
  bool Connect(vtkAlgorithmOutput* output);

  vtkDataObject* GetData() const { return this->Data; }
  vtkAlgorithmOutput* GetConnection() const;

  // Returns the time of the last change of the data, or of anything upstream. Asks the pipeline for
  // its modification time; not thread-safe.
  vtkMTimeType FindMTime();
  // Returns the result of the last FindMTime for an algorithm, the MTime of a given data set, or 0
  // if there is no input. Cheap and thread-safe.
  vtkMTimeType GetMTime() const;

  // Calls read() in one thread if the input (GetMTime) or the function (`changed`) has changed
  // since the last call. Other threads wait.
  template <class Read>
  void ReadIfChanged(vtkMTimeType changed, Read&& read);

  // Updates the algorithm's whole output, if an algorithm is connected, at the time of the last
  // request. Not thread-safe.
  void Update();

private:
  void Remember();

  vtkSmartPointer<vtkDataObject> Data;
  vtkSmartPointer<vtkAlgorithm> Producer;
  int Port = 0;

  // MTimes of the algorithm's pipeline and data at the last change that FindMTime found, or at the
  // last Update.
  vtkMTimeType PipelineTime = 0;
  vtkMTimeType DataTime = 0;
  std::atomic<vtkMTimeType> Changed{ 0 };

  std::mutex Reading;
  std::atomic<vtkMTimeType> ReadTime{ 0 };
};

template <class Read>
void FunctionInput::ReadIfChanged(vtkMTimeType changed, Read&& read)
{
  const vtkMTimeType latest = std::max(changed, this->GetMTime());
  if (this->ReadTime.load(std::memory_order_acquire) == latest)
  {
    return;
  }
  const std::lock_guard<std::mutex> lock(this->Reading);
  if (this->ReadTime.load(std::memory_order_relaxed) != latest)
  {
    // Isolated: a waiting thread could otherwise run an evaluation that waits for this read.
    tbb::this_task_arena::isolate([&read] { read(); });
    this->ReadTime.store(latest, std::memory_order_release);
  }
}

}

#endif
