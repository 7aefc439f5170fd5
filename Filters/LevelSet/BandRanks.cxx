// Bands partitioned among ranks, and their conversion to whole bands.

#include "BandState.h"
#include "NarrowBand.h"
#include "State/PackedBand.h"

#include <algorithm>
#include <string>

namespace activesurface
{

void BandState::SetPart(const std::shared_ptr<const BandPart>& part)
{
  this->Part = part;
  this->Leaves.SetDomain(part ? part->Space.get() : nullptr);
}

void NarrowBand::SetDomain(const std::shared_ptr<const Domain>& domain)
{
  this->State->Space = domain;
}

const BandPart* NarrowBand::GetPart() const
{
  return this->State->Part.get();
}

std::shared_ptr<const BandPart> NarrowBand::SharePart() const
{
  return this->State->Part;
}

void NarrowBand::ListCosts(std::vector<LeafCost>& costs) const
{
  constexpr double costOfLeaf = 100.0; // [cost of a particle]
  const LeafTable& leaves = this->State->Leaves;
  for (std::size_t i = 0; i < leaves.Size(); ++i)
  {
    if (this->State->Part && !leaves.SummaryOf(i).IsForeign)
    {
      costs.push_back(
        { { leaves[i].Origin[0], leaves[i].Origin[1], leaves[i].Origin[2] }, costOfLeaf });
    }
  }
}

std::unique_ptr<NarrowBand> NarrowBand::GatherWhole(bool onAll) const
{
  const BandState& members = *this->State;
  const Agreement& ranks = members.Part->GetRanks();
  std::string own;
  PackBand(members.Leaves, members.HasGhosts, own);
  const Bytes bytes(own.begin(), own.end());
  const std::vector<Bytes> all = onAll ? ranks.Exchange(bytes) : ranks.GatherToFirst(bytes);
  if (all.empty())
  {
    return nullptr;
  }
  auto whole = std::make_unique<NarrowBand>(members.VoxelSize);
  this->CopyNumbersTo(*whole);
  whole->State->SetPart(nullptr);
  std::vector<std::string> parts;
  std::transform(all.begin(), all.end(), std::back_inserter(parts),
    [](const Bytes& part) { return std::string(part.begin(), part.end()); });
  whole->Run([&] { whole->State->Restore(UnpackBand(parts, members.GetBackground())); });
  return whole;
}

void NarrowBand::MakeWhole()
{
  if (this->State->Part)
  {
    const std::unique_ptr<NarrowBand> whole = this->GatherWhole(true);
    this->State.swap(whole->State);
  }
  this->State->Space.reset();
}

}
