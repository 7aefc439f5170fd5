// Replaces the whole potential: by an empty potential, or by a tree.

#include "BandState.h"

#include "Leaves/GhostFill.h"
#include "Leaves/Layers.h"

#include <algorithm>

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
  this->NoPartsBefore = AnyTime;
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
  if (!this->HasGhosts)
  {
    this->BoundLayers();
  }
  else if (!this->Paper)
  {
    this->FillGhostsOfAll();
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

// Clamps the layers to +-NodeLimit, as the node scheme does. Without the clamp, nodes of the layers
// would have + or - the background in leaves that the node scheme has not created.
void BandState::BoundLayers()
{
  this->Leaves.ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = this->Leaves[i];
      leaf.UpToLayer[LastLayer].ForEach([&leaf](int node)
        { leaf.Value[node] = std::min(std::max(leaf.Value[node], -NodeLimit), NodeLimit); });
    });
}

}
