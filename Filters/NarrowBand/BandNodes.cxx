// Time steps of a band by the node scheme, see Nodes/NodeStep.h.

#include "BandState.h"

namespace activesurface
{

namespace
{

bool IsControlled(const Motion& motion)
{
  return motion.VolumeControl == Control::Exact || motion.AreaControl == Control::Exact;
}

}

void BandState::MakeNodeFrame(const NodeFrame& frame, const Motion& motion, NodeTarget& target)
{
  const openvdb::FloatTree::Ptr before = this->Potential->treePtr();
  const openvdb::FloatTree::Ptr after = this->Nodes.Make(frame, motion, target);
  const bool hadGhosts = this->HasGhosts;
  try
  {
    this->HasGhosts = IsControlled(motion); // which moves the surface by a substep
    this->Leaves = LeafTable();             // all leaves are new
    this->Restore(after);
    if (frame.End > frame.Begin)
    {
      this->RestoreControlled(motion);
    }
  }
  catch (...)
  {
    this->Leaves = LeafTable();
    this->HasGhosts = hadGhosts;
    this->Restore(before);
    throw;
  }
}

void BandState::AdvanceOnNodes(
  double end, const Motion& motion, Target& target, AdvanceReport& report)
{
  const OldPotential old{ this->Leaves, this->Potential->tree() };
  const double duration = end - this->Time;
  this->MakeNodeFrame(
    { old, this->Time, end, duration, this->VoxelSize, this->Maximum }, motion, *target.GetNodes());
  ++report.Substeps;
  report.TargetEvaluations += this->Nodes.CountEvaluations();
}

void BandState::StartOnNodes(const Motion& motion, double duration, Target& target)
{
  const OldPotential old{ this->Leaves, this->Potential->tree() };
  this->MakeNodeFrame({ old, this->Time, this->Time, duration, this->VoxelSize, this->Maximum },
    motion, *target.GetNodes());
  CheckSize(this->CountActive(), this->Maximum);
  this->StartMeasure = this->Measure();
}

}
