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
  static constexpr double AnyTime = -std::numeric_limits<double>::infinity();

  double VoxelSize = 1.0;
  double Time = 0.0;
  int Threads = 0;
  std::size_t Maximum = std::numeric_limits<std::size_t>::max();
  openvdb::FloatGrid::Ptr Potential;
  LeafTable Leaves;
  std::size_t Crossings = 0;
  SkinMeasure StartMeasure;       // world units
  double BoxSize = 1.0;           // longest side of the bounds at the start
  bool Paper = false;             // true: the paper's scheme, see PaperStep.h
  bool HasGhosts = true;          // false: layers 3 and 4 have values up to NodeLimit
  double NoPartsBefore = AnyTime; // end of the frame in which a penalty removed the surface
  AdvanceReport Work;             // since the start or ForgetWork
  ActiveSet Set;                  // leaves of the current substep; kept for its capacity
  SubstepBuffers Buffers;
  Displacement Trace;
  SteadyWindow Window;
  std::shared_ptr<const BandPart> Part; // null: the band is whole
  std::shared_ptr<const Domain> Space;  // null: the next frames are not partitioned
  FetchedLeaves Fetched;                // kept for its capacity
  BandBackup Backup;                    // state before new parts
  NodeStep Nodes;                       // kept for its capacity

  void MakeEmpty();
  /** Starts an empty surface at a time. bounds: only their size is used. */
  void Reset(double time, const double bounds[6]);
  /** Replaces the potential. Derives the layers and the active nodes from the signs; in the paper's
   * scheme, active nodes also depend on the tree's active masks. */
  void AdoptTree(const openvdb::FloatTree::Ptr& tree);
  /** Replaces the potential and the layers. Extrapolates the ghosts from the active nodes, except
   * in the paper's scheme; without HasGhosts, clamps the layers to +-NodeLimit instead. */
  void Restore(const openvdb::FloatTree::Ptr& tree);
  /** Sets the totals of a partitioned band; null: the band is whole. Also sets the domain with
   * which LeafTable::Rebuild finds the owners of leaves. */
  void SetPart(const std::shared_ptr<const BandPart>& part);
  /** Extrapolates the ghosts, which explicit substeps need, unless the band has ghosts. */
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
    this->NoPartsBefore = AnyTime;
  }
  float GetBackground() const { return this->Paper ? PaperThreshold : Far; }
  /** Call before the first substep of a motion. */
  void Begin(const Motion& motion);

  void CreateParts(const Motion& motion, const Target& target, AdvanceReport& report);
  void Step(double end, const Motion& motion, Target& target, AdvanceReport& report);
  /** Makes one explicit substep without an end time. Measures SurfaceSpeed for the report. */
  void StepAndTrace(const Motion& motion, Target& target, AdvanceReport& report);

  /** Clips the surface at walls and obstacle, between motions. Area and volume are measured again,
   * and count as the values at the start. */
  void Confine(const Walls& walls, Obstacle* obstacle);

  /** Restores the area or volume of an exact control: moves the surface by at most 1.5 voxels, or
   * 12 voxels in the node scheme. Does nothing without an exact control. */
  void RestoreControlled(const Motion& motion);
  void FinishFrame();

  /** Sets the surface to the target at the band's time, then applies attraction and tension for
   * `duration`. With NodeFreedom, applies only tension, for 6 / Attraction. */
  void StartOnNodes(const Motion& motion, double duration, Target& target);
  std::size_t CountActive() const
  {
    return this->Part
      ? this->Part->ActiveNodes
      : this->Leaves.Count([](const LeafSummary& leaf) { return leaf.ActiveNodes; });
  }
  /** Returns area and volume of all ranks in world units. */
  SkinMeasure Measure() const;

private:
  struct Move;
  OldPotential GetOld();
  void MakeNodeFrame(const NodeFrame& frame, const Motion& motion, NodeTarget& target);
  void FillGhostsOfAll();
  void BoundLayers();

  /** Finds the layers from the signs. Then finds the active nodes and, except in the paper's
   * scheme, the ghosts. */
  void RebuildBand(ActiveSet& set);
  /** Drops empty leaves if more than an eighth of all leaves are empty; counts the crossings. */
  void DropEmptyLeaves();
  /** Converts the band to the scheme of this motion: this library's or the paper's. */
  void SwitchScheme(const Motion& motion);

  TargetLimits FollowTarget(
    const Motion& motion, Target& target, AdvanceReport& report, Move& move);
  void Restore();
  FollowingBand GetFollower();
  PenaltyForce FindForce(const Motion& motion) const;
  /** Makes an explicit substep. If it throws, removes the parts that the substep has created. */
  void MakeStep(const Motion& motion, Target& target, AdvanceReport& report, Move& move);
  void TryStep(const Motion& motion, Target& target, AdvanceReport& report, Move& move);
  void AdvanceOnNodes(double end, const Motion& motion, Target& target, AdvanceReport& report);
  void MakeDefaultStep(const Motion& motion, const TargetLimits& limits, Move& move);
  void MakePaperStep(const Motion& motion, Move& move);
};

}

#endif
