/**
 * The potential of the last frame.
 */
#ifndef OldPotential_h
#define OldPotential_h

#include "Base/IndexMap.h"
#include "Base/NodeTarget.h"
#include "Leaves/LeafTable.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

class Domain;

/** A leaf of the last frame; the pointers are null if the leaf does not exist. */
struct OldLeaf
{
  const float* Value = nullptr;          //< 512 values
  const LeafMask* FirstLayers = nullptr; //< nodes of the layers 0 and 1
};

/** Leaves of the last frame that this rank has received from their owners. */
class FetchedLeaves
{
public:
  void Clear();

  bool IsOfOther(const NodeIndex& origin) const
  {
    return !this->Leaves.empty() && this->Numbers.Find(origin) != IndexMap::None;
  }
  OldLeaf Find(const NodeIndex& origin) const
  {
    const Leaf& leaf = this->Leaves[static_cast<std::size_t>(this->Numbers.Find(origin))];
    return leaf.Kind == IsLeaf ? OldLeaf{ leaf.Value, &leaf.FirstLayers } : OldLeaf();
  }
  bool IsInside(const NodeIndex& origin) const
  {
    return this->Leaves[static_cast<std::size_t>(this->Numbers.Find(origin))].Kind == Inside;
  }

private:
  friend struct OldPotential;
  enum LeafKind : int
  {
    Outside,
    Inside,
    IsLeaf
  };
  struct Leaf
  {
    float Value[512];
    LeafMask FirstLayers;
    LeafKind Kind;
  };

  IndexMap Numbers;
  std::vector<Leaf> Leaves;
};

struct OldPotential
{
  const LeafTable& Leaves;
  const PotentialTree& Tree;
  const Domain* Space = nullptr; //< partition of the last frame; null: this rank has all leaves
  FetchedLeaves* Fetched = nullptr;

  /** Collective. Replaces the fetched leaves by the wanted leaves that other ranks own. wanted:
   * origins. */
  void Fetch(const std::vector<NodeIndex>& wanted);

  OldLeaf FindLeaf(const NodeIndex& origin) const
  {
    return this->IsFetched(origin) ? this->Fetched->Find(origin) : this->FindOwn(origin);
  }

  /** The 512 values of a leaf, or null. */
  const float* Find(const NodeIndex& origin) const { return this->FindLeaf(origin).Value; }

  /** Returns + or - NodeLimit: the side of a leaf for which Find returns null. */
  float SideOf(const NodeIndex& origin) const
  {
    const bool isInside =
      this->IsFetched(origin) ? this->Fetched->IsInside(origin) : this->IsInsideHere(origin);
    return isInside ? -NodeLimit : NodeLimit;
  }

private:
  bool IsFetched(const NodeIndex& origin) const
  {
    return this->Fetched && this->Fetched->IsOfOther(origin);
  }
  OldLeaf FindOwn(const NodeIndex& origin) const
  {
    const std::int32_t i = this->Leaves.Find(openvdb::Coord(origin[0], origin[1], origin[2]));
    return i >= 0 ? OldLeaf{ this->Leaves[i].Value, &this->Leaves[i].UpToLayer[1] } : OldLeaf();
  }
  bool IsInsideHere(const NodeIndex& origin) const
  {
    return this->Tree.getValue(openvdb::Coord(origin[0], origin[1], origin[2])) < 0.f;
  }
  std::vector<char> Answer(const std::vector<NodeIndex>& wanted) const;
};

}

#endif
