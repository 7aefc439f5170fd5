// Executive of a filter that runs on several ranks together. The filter executes even if its input
// has failed on this rank: it then joins the collective call in which the other ranks wait, and
// reports the failure there.

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

  // Turns this behaviour on or off for an algorithm with this executive; another executive is left
  // unchanged. If off, this executive does what its superclass does.
  static void SetIsOneOfMany(vtkAlgorithm* algorithm, bool isOneOfMany);

  // Returns true if the inputs failed at their last request; false for another executive.
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
