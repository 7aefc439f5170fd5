// Replaces the whole potential: by an empty potential, or by a tree.

#include "BandState.h"

#include "Leaves/GhostFill.h"
#include "Leaves/Layers.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

void BandState::MakeEmpty()
{
  this->Potential = openvdb::FloatGrid::create(Far);
  this->SetPart(nullptr);
  this->Leaves.SetBackground(Far);
  this->Leaves.Rebuild(this->Potential->tree());
  this->Crossings = 0;
  this->Paper = false;
  this->HasGhosts = true;
}

void BandState::Reset(double time, const double bounds[6])
{
  this->MakeEmpty();
  this->Time = time;
  this->StartMeasure = SkinMeasure();
  this->Work = AdvanceReport();
  this->BoxSize = std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
}

void BandState::AdoptTree(const openvdb::FloatTree::Ptr& tree)
{
  this->Potential->setTree(tree);
  this->Leaves.SetBackground(this->GetBackground());
  this->Leaves.Rebuild(*tree);
  ReadActiveMasks(this->Leaves);
  this->Set.ChooseAll(this->Leaves);
  if (this->Paper)
  {
    RebuildPaperBand(this->Leaves, this->Set, *tree);
  }
  else
  {
    RebuildLayers(this->Leaves, this->Set, *tree);
  }
  const std::size_t crossings = NumberCrossings(this->Leaves);
  this->Crossings = this->Part ? this->Part->Crossings : crossings;
}

void BandState::Restore(const openvdb::FloatTree::Ptr& tree)
{
  this->AdoptTree(tree);
  if (!this->Paper)
  {
    this->BoundLayers(this->HasGhosts ? Far : NodeLimit);
    if (this->HasGhosts)
    {
      this->FillGhostsOfAll();
    }
  }
  this->FinishFrame();
}

void BandState::FillGhostsOfAll()
{
  for (std::size_t i = 0; i < this->Leaves.Size(); ++i)
  {
    this->Leaves[i].Updated = LeafMask::All();
  }
  FillGhosts(this->Leaves, this->Set);
}

void BandState::AddGhosts()
{
  if (!this->HasGhosts)
  {
    this->Set.ChooseAll(this->Leaves);
    this->FillGhostsOfAll();
    this->HasGhosts = true;
  }
}

// Sets values of the layers with a magnitude of at least `least` to +-NodeLimit. The node scheme
// does not create leaves of which all nodes have +-NodeLimit, so their nodes have the background,
// +-Far.
void BandState::BoundLayers(float least)
{
  this->Leaves.ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = this->Leaves[i];
      leaf.UpToLayer[LastLayer].ForEach(
        [&leaf, least](int node)
        {
          if (std::fabs(leaf.Value[node]) >= least)
          {
            leaf.Value[node] = std::copysign(NodeLimit, leaf.Value[node]);
          }
        });
    });
}

}
