// Frames of a band by the node scheme; see Nodes/NodeStep.h.

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

OldPotential BandState::GetOld()
{
  const Domain* space = this->Part ? this->Part->Space.get() : nullptr;
  this->Fetched.Clear();
  return { this->Leaves, this->Potential->tree(), space, &this->Fetched };
}

void BandState::MakeNodeFrame(const NodeFrame& frame, const Motion& motion, NodeTarget& target)
{
  const openvdb::FloatTree::Ptr before = this->Potential->treePtr();
  const openvdb::FloatTree::Ptr after = this->Nodes.Make(frame, motion, target);
  const bool hadGhosts = this->HasGhosts;
  const std::shared_ptr<const BandPart> partBefore = this->Part;
  try
  {
    this->HasGhosts = false;
    this->Leaves = LeafTable(); // all leaves are new
    this->SetPart(nullptr);
    this->Leaves.SetDomain(this->Space.get());
    this->Restore(after);
    if (this->Space)
    {
      this->SetPart(CountTogether(this->Leaves, this->Space));
      this->Crossings = this->Part->Crossings;
    }
    if (IsControlled(motion)) // an exact control moves the surface and needs ghosts
    {
      this->AddGhosts();
    }
    if (frame.End > frame.Begin)
    {
      this->RestoreControlled(motion);
    }
  }
  catch (...)
  {
    this->Leaves = LeafTable();
    this->SetPart(partBefore);
    this->HasGhosts = hadGhosts;
    this->Restore(before);
    throw;
  }
}

void BandState::AdvanceOnNodes(
  double end, const Motion& motion, Target& target, AdvanceReport& report)
{
  OldPotential old = this->GetOld();
  const double duration = end - this->Time;
  this->MakeNodeFrame(
    { old, this->Time, end, duration, this->VoxelSize, this->Maximum, this->Space.get() }, motion,
    *target.GetNodes());
  ++report.Substeps;
  report.TargetEvaluations += this->Nodes.CountEvaluations();
}

void BandState::StartOnNodes(const Motion& motion, double duration, Target& target)
{
  OldPotential old = this->GetOld();
  this->MakeNodeFrame(
    { old, this->Time, this->Time, duration, this->VoxelSize, this->Maximum, this->Space.get() },
    motion, *target.GetNodes());
  CheckSize(this->CountActive(), this->Maximum);
  this->StartMeasure = this->Measure();
}

}
