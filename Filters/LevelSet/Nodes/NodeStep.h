/**
 * A frame of the node scheme. The motion of the target carries the potential; the first frame, and
 * each frame with NodeFreedom, begins at the target instead. The target is evaluated once, at the
 * nodes near its surface. Stages apply attraction and tension (NodeStages.h).
 *
 * The scheme needs no extension of speeds and no search for parts. Where the target has a new part,
 * the distance to the target is negative, so the part appears. Where the target has lost a part,
 * the skin disappears.
 */
#ifndef NodeStep_h
#define NodeStep_h

#include "Base/Motion.h"
#include "Base/NodeTarget.h"
#include "Nodes/NodeCarry.h"
#include "Nodes/NodeHalo.h"
#include "Nodes/NodeStages.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

/** A frame and the state of the last frame. */
struct NodeFrame
{
  OldPotential& Old;
  double Begin, End; //< times of the band; if equal, the frame begins at the target
  double Duration;   //< of attraction and tension; End - Begin if End > Begin
  double VoxelSize;
  std::size_t MaximumNumberOfActiveVoxels;
  const Domain* Space = nullptr; //< partition among ranks; null: this rank owns all
};

class NodeStep
{
public:
  /**
   * Returns a tree with the potential at the end of the frame. Throws std::runtime_error if the
   * shell has too many leaves for the maximum of active voxels, or if the obstacle is NaN. Buffers
   * are kept for the next call.
   */
  openvdb::FloatTree::Ptr Make(const NodeFrame& frame, const Motion& motion, NodeTarget& target);

  /** Returns the number of this rank's nodes at which the last frame evaluated the target. */
  std::size_t CountEvaluations() const;

private:
  void FindLeaves(const NodeFrame& frame, const Motion& motion, const NodeTarget& target);
  void AddConfined(const NodeFrame& frame, const Motion& motion);
  void SampleSolid(std::size_t own, Obstacle& solid) const;
  bool FindDepths(const NodeIndex& origin, const NodeFrame& frame, const Motion& motion,
    float (&depths)[512]) const;
  bool IsSolid(const NodeIndex& origin, const NodeFrame& frame, const Motion& motion) const;
  void Evaluate(const NodeTarget& target);
  bool IsFree() const { return this->Freedom.HalfWidth > 0.f; }
  StageCoefficients FindCoefficients(
    const NodeFrame& frame, const Motion& motion, const NodeTarget& target) const;
  static bool IsNearWall(const NodeIndex& origin, const NodeFrame& frame, const Motion& motion);
  void RestOnWalls(const NodeFrame& frame, const Motion& motion, float gap);
  void Confine(NodeArrays& numbers, float unit, const NodeFrame& frame, const Motion& motion);
  void FetchOld(const NodeFrame& frame, const NodeTarget& target);
  void Carry(const NodeFrame& frame, const NodeTarget& target);
  void ConvertToVoxels();
  bool StaysFar(std::size_t i) const;
  void Repeat(const NodeFrame& frame, const Motion& motion, const NodeTarget& target);
  void KeepWhatRests(const OldPotential& old, float tolerance);
  openvdb::FloatTree::Ptr MakeTree(const NodeFrame& frame, const Motion& motion) const;
  void AddSides(const NodeFrame& frame, const Motion& motion, openvdb::FloatTree& tree) const;

  Shell Near;
  NodeHalo Halo;
  NodeLeaves Leaves;
  NodeArrays Potential, Room, Psi, Slack;
  NodeFreedom Freedom; //< of the current frame
  std::vector<LeafBulk> Bulk;
  std::vector<LeafMotion> Motions; //< of each leaf, if other ranks own some old leaves
  std::vector<char> IsStill;       //< LeafMotion::IsStill of each leaf
  std::vector<char> IsFar;         //< leaves far from the target and from the skin
};

}

#endif
