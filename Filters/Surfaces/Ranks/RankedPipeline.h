// Executive of a filter that runs on several ranks together. The filter executes even if its input
// has failed on this rank. In this case the filter joins the collective call in which the other
// ranks wait, and there reports the failure.

#ifndef RankedPipeline_h
#define RankedPipeline_h

#include "vtkCompositeDataPipeline.h"

#include <set>

class vtkInformationRequestKey;

namespace activesurface
{

class RankedPipeline : public vtkCompositeDataPipeline
{
public:
  static RankedPipeline* New();
  vtkTypeMacro(RankedPipeline, vtkCompositeDataPipeline);

  // Turns the execution after a failure of the input on or off. If off, this executive does what
  // its superclass does. Does nothing for an algorithm with another executive.
  static void SetIsOneOfMany(vtkAlgorithm* algorithm, bool isOneOfMany);

  // Returns true if an input failed at the last request of at least one kind (information, data
  // ...); false for another executive.
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
  std::set<vtkInformationRequestKey*> Failed; // kinds of requests whose last one failed
};

}

#endif
