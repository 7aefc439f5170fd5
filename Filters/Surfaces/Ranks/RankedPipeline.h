// An executive for ranks that work together: an input that has failed on one of them is no reason
// for that rank not to be called. It comes to the round in which the others wait for it, and tells
// them.

#ifndef RankedPipeline_h
#define RankedPipeline_h

#include "vtkCompositeDataPipeline.h"

namespace activesurface
{

class RankedPipeline : public vtkCompositeDataPipeline
{
public:
  static RankedPipeline* New();
  vtkTypeMacro(RankedPipeline, vtkCompositeDataPipeline);

  // Of an algorithm that has such an executive; another one is left as it is. Off: it does what any
  // other does.
  static void SetIsOneOfMany(vtkAlgorithm* algorithm, bool isOneOfMany);

  // Whether the inputs have failed, when they were asked last. False for another executive.
  static bool HaveInputsFailed(vtkAlgorithm* algorithm);

protected:
  RankedPipeline() = default;
  ~RankedPipeline() override = default;

  using vtkCompositeDataPipeline::ForwardUpstream;
  int ForwardUpstream(vtkInformation* request) override;

private:
  RankedPipeline(const RankedPipeline&) = delete;
  void operator=(const RankedPipeline&) = delete;

  bool IsOneOfMany = false;
  bool InformationFailed = false;
  bool DataFailed = false;
};

}

#endif
