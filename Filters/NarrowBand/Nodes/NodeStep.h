/**
 * A frame of the node scheme: the potential is carried by the motion of the target, the target is
 * evaluated once, at the nodes near its surface, and stages bring the potential to it.
 *
 * Nothing is iterated, extended or searched for: where the target has a new part, psi is negative
 * there, and a part appears; where it has none any more, the skin ends.
 */
#ifndef NodeStep_h
#define NodeStep_h

#include "Motion.h"
#include "NodeTarget.h"
#include "Nodes/NodeCarry.h"
#include "Nodes/NodeHalo.h"
#include "Nodes/NodeStages.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

/** A frame, from the state of the last one. */
struct NodeFrame
{
  OldPotential& Old;
  double Begin, End; //< motion times; equal for a start, which begins on the target itself
  double Duration;   //< of attraction and tension; End - Begin, but for a start
  double VoxelSize;
  std::size_t MaximumNumberOfActiveVoxels;
  const Domain* Space = nullptr; //< shared out to ranks; null: all is this rank's
};

class NodeStep
{
public:
  /** Returns a tree with the potential at the end of the frame. Throws std::runtime_error beyond
   * the maximum of active voxels, or where the obstacle is not a number. Keeps its memory. */
  openvdb::FloatTree::Ptr Make(const NodeFrame& frame, const Motion& motion, NodeTarget& target);

  /** Number of nodes at which the last frame has evaluated the target. */
  std::size_t CountEvaluations() const;

private:
  void FindLeaves(const NodeFrame& frame, const Motion& motion, const NodeTarget& target);
  void AddConfined(const NodeFrame& frame, const Motion& motion);
  void SampleSolid(std::size_t own, Obstacle& solid) const;
  bool FindDepths(const NodeIndex& origin, const NodeFrame& frame, const Motion& motion,
    float (&depths)[512]) const;
  bool IsSolid(const NodeIndex& origin, const NodeFrame& frame, const Motion& motion) const;
  void Evaluate(const NodeTarget& target);
  void Confine(NodeArrays& numbers, const NodeFrame& frame, const Motion& motion);
  void FetchOld(const NodeFrame& frame, const NodeTarget& target);
  void Carry(const NodeFrame& frame, const NodeTarget& target);
  bool StaysFar(std::size_t i) const;
  void Repeat(const NodeFrame& frame, const Motion& motion, const NodeTarget& target);
  void KeepWhatRests(const OldPotential& old, float tolerance);
  openvdb::FloatTree::Ptr MakeTree(const NodeFrame& frame, const Motion& motion) const;
  void AddSides(const NodeFrame& frame, const Motion& motion, openvdb::FloatTree& tree) const;

  Shell Near;
  NodeHalo Halo;
  NodeLeaves Leaves;
  NodeArrays Potential, Room, Psi;
  std::vector<LeafBulk> Bulk;
  std::vector<LeafMotion> Motions; //< of each leaf, where the old ones are on several ranks
  std::vector<char> IsStill;       //< leaves in which the target has not moved
  std::vector<char> IsFar;         //< leaves that neither the target nor the skin is near
};

}

#endif
