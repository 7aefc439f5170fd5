/**
 * The state of a NarrowBand, and its substep.
 */
#ifndef BandState_h
#define BandState_h

#include "BandPart.h"
#include "Base/Motion.h"
#include "Base/Target.h"
#include "Front/Displacement.h"
#include "Front/PaperStep.h"
#include "Front/SkinMeasure.h"
#include "Front/SubstepBuffers.h"
#include "Front/TimeStep.h"
#include "Leaves/ActiveSet.h"
#include "Leaves/BandBackup.h"
#include "Nodes/NodeStep.h"
#include "State/StateGrid.h"

#include <limits>

namespace activesurface
{

struct FollowingBand;

struct BandState
{
  double VoxelSize = 1.0;
  double Time = 0.0;
  int Threads = 0;
  std::size_t Maximum = std::numeric_limits<std::size_t>::max();
  openvdb::FloatGrid::Ptr Potential;
  LeafTable Leaves;
  std::size_t Crossings = 0;
  SkinMeasure StartMeasure; // world units
  double BoxSize = 1.0;     // longest side of the bounds at the start
  bool Paper = false;       // the band is the paper's: see PaperStep.h
  bool HasGhosts = true;    // else the node scheme has set all nodes of the layers
  AdvanceReport Work;       // since ForgetWork
  ActiveSet Set;            // of the substep under way, which sets it first; kept for its memory
  SubstepBuffers Buffers;
  Displacement Trace;
  SteadyWindow Window;
  std::shared_ptr<const BandPart> Part; // null: the band is whole
  std::shared_ptr<const Domain> Space;  // of the next frames; null: they are whole
  FetchedLeaves Fetched;                // kept for its memory
  BandBackup Backup;                    // of what was before new parts
  NodeStep Nodes;                       // kept for its memory

  void MakeEmpty();
  /** An empty surface that begins at a time; bounds: for the size of the model. */
  void Reset(double time, const double bounds[6]);
  /** Replaces the potential; the layers follow from the signs, in the paper's band from the active
   * masks. */
  void AdoptTree(const openvdb::FloatTree::Ptr& tree);
  /** Replaces the potential; ghosts follow from its active nodes. */
  void Restore(const openvdb::FloatTree::Ptr& tree);
  /** Says of which whole the leaves are a part; comes before they are replaced. */
  void SetPart(const std::shared_ptr<const BandPart>& part);
  /** Makes the ghosts, which substeps need. */
  void AddGhosts();
  StateNumbers GetNumbers() const
  {
    return { this->VoxelSize, this->Time, this->StartMeasure.Area, this->StartMeasure.Volume,
      this->BoxSize, this->Paper, this->HasGhosts, this->GetBackground() };
  }
  void SetNumbers(const StateNumbers& numbers)
  {
    this->VoxelSize = numbers.VoxelSize;
    this->Time = numbers.Time;
    this->StartMeasure = { numbers.StartArea, numbers.StartVolume };
    this->BoxSize = numbers.BoxSize;
    this->Paper = numbers.Paper;
    this->HasGhosts = numbers.HasGhosts;
  }
  float GetBackground() const { return this->Paper ? PaperThreshold : Far; }
  /** To be called before the first substep of a motion. */
  void Begin(const Motion& motion);

  void CreateParts(const Motion& motion, const Target& target, AdvanceReport& report);
  void Step(double end, const Motion& motion, Target& target, AdvanceReport& report);
  /** One substep of any length; the report's SurfaceSpeed is its measured speed. */
  void StepAndTrace(const Motion& motion, Target& target, AdvanceReport& report);

  /** To be called between motions: the surface counts as just started. */
  void Confine(const Walls& walls, Obstacle* obstacle);

  /** Moves the surface to what an exact control holds, by a voxel and a half at the most. */
  void RestoreControlled(const Motion& motion);
  void FinishFrame();

  /** The surface of the target at the time, after attraction and tension of such a duration. */
  void StartOnNodes(const Motion& motion, double duration, Target& target);
  std::size_t CountActive() const
  {
    return this->Part
      ? this->Part->ActiveNodes
      : this->Leaves.Count([](const LeafSummary& leaf) { return leaf.ActiveNodes; });
  }
  /** Area and volume of all ranks in world units. */
  SkinMeasure Measure() const;

private:
  struct Move;
  OldPotential GetOld();
  void MakeNodeFrame(const NodeFrame& frame, const Motion& motion, NodeTarget& target);
  void FillGhostsOfAll();
  void BoundLayers();

  /** Layers and ghosts, from the potential. */
  void RebuildBand(ActiveSet& set);
  /** Once they are many; counts the crossings. */
  void DropEmptyLeaves();
  /** Converts the band to the scheme of this motion: this library's or the paper's. */
  void SwitchScheme(const Motion& motion);

  TargetLimits FollowTarget(
    const Motion& motion, Target& target, AdvanceReport& report, Move& move);
  void TakeBack();
  FollowingBand GetFollower();
  PenaltyForce FindForce(const Motion& motion) const;
  void MakeStep(const Motion& motion, Target& target, AdvanceReport& report, Move& move);
  void AdvanceOnNodes(double end, const Motion& motion, Target& target, AdvanceReport& report);
  void MakeDefaultStep(const Motion& motion, const TargetLimits& limits, Move& move);
  void MakePaperStep(const Motion& motion, Move& move);
};

}

#endif
