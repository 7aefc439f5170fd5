// The data set that an implicit function reads: one that is given, or the output of an algorithm,
// which is brought up to date when the function reads it. Functions are no algorithms, no pipeline
// does so for them.

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
  // Each lets the other go; true if that is a change, later than any that FindMTime has found.
  bool SetData(vtkDataObject* data);
  bool Connect(vtkAlgorithmOutput* output);

  vtkDataObject* GetData() const { return this->Data; }
  vtkAlgorithmOutput* GetConnection() const;

  // Of the last change of the data, or of anything upstream. Asks the pipeline: not for threads.
  vtkMTimeType FindMTime();
  // The same as of the last FindMTime, cheap and for threads.
  vtkMTimeType GetMTime() const;

  // Calls read() by one thread, unless nothing has changed since the last call: neither the input,
  // as GetMTime has it, nor the function, as of changed. Others wait.
  template <class Read>
  void ReadIfChanged(vtkMTimeType changed, Read&& read);

  // Brings all of the algorithm's output up to date, at the time that it was last asked for. By one
  // thread.
  void Update();

private:
  void Remember();

  vtkSmartPointer<vtkDataObject> Data;
  vtkSmartPointer<vtkAlgorithm> Producer;
  int Port = 0;

  // What is known of the algorithm since the last look at it.
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
    // Tasks of its own: one of the evaluations that wait for it would wait for itself.
    tbb::this_task_arena::isolate([&read] { read(); });
    this->ReadTime.store(latest, std::memory_order_release);
  }
}

}

#endif
