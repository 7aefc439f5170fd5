#include "Nodes/OldPotential.h"

#include "Ranks/Domain.h"
#include "Ranks/RankBytes.h"

#include <algorithm>
#include <utility>

namespace activesurface
{

void FetchedLeaves::Clear()
{
  this->Numbers.Clear(0);
  this->Leaves.clear();
}

void OldPotential::Fetch(const std::vector<NodeIndex>& wanted)
{
  this->Fetched->Clear();
  if (!this->Space)
  {
    return;
  }
  const Agreement& ranks = this->Space->GetRanks();
  std::vector<std::vector<NodeIndex>> ofEach(static_cast<std::size_t>(ranks.GetSize()));
  IndexMap known;
  for (const NodeIndex& origin : wanted)
  {
    const int owner = this->Space->OwnerOf(origin);
    const std::size_t before = known.Size();
    if (owner != ranks.GetRank() && static_cast<std::size_t>(known.Add(origin)) == before)
    {
      ofEach[static_cast<std::size_t>(owner)].push_back(origin);
    }
  }
  std::vector<Bytes> requests, answers;
  std::transform(ofEach.begin(), ofEach.end(), std::back_inserter(requests), ToBytes<NodeIndex>);
  for (const Bytes& request : ranks.Distribute(std::move(requests)))
  {
    answers.push_back(this->Answer(FromBytes<NodeIndex>(request)));
  }
  const std::vector<Bytes> received = ranks.Distribute(std::move(answers));
  for (std::size_t rank = 0; rank < received.size(); ++rank)
  {
    const auto leaves = FromBytes<FetchedLeaves::Leaf>(received[rank]);
    this->Fetched->Leaves.insert(this->Fetched->Leaves.end(), leaves.begin(), leaves.end());
    for (const NodeIndex& origin : ofEach[rank])
    {
      this->Fetched->Numbers.Add(origin);
    }
  }
}

std::vector<char> OldPotential::Answer(const std::vector<NodeIndex>& wanted) const
{
  std::vector<FetchedLeaves::Leaf> leaves(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    FetchedLeaves::Leaf& leaf = leaves[i];
    const OldLeaf own = this->FindOwn(wanted[i]);
    leaf.Kind = own.Value             ? FetchedLeaves::IsLeaf
      : this->IsInsideHere(wanted[i]) ? FetchedLeaves::Inside
                                      : FetchedLeaves::Outside;
    if (own.Value)
    {
      std::copy_n(own.Value, 512, leaf.Value);
      leaf.FirstLayers = *own.FirstLayers;
    }
    else
    {
      std::fill_n(leaf.Value, 512, 0.f);
    }
  }
  return ToBytes(leaves);
}

}
