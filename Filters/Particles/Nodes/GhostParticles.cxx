#include "Nodes/GhostParticles.h"

#include <algorithm>

namespace activesurface
{

void GhostParticles::Find(const Domain* domain, int margin, std::size_t count,
  const std::function<NodeIndex(std::size_t)>& nodeOf)
{
  this->Space = domain;
  this->Listed.clear();
  this->IsOwnListed.clear();
  this->Own.clear();
  if (!domain)
  {
    return;
  }
  const auto size = static_cast<std::size_t>(domain->GetRanks().GetSize());
  const int rank = domain->GetRanks().GetRank();
  this->Sent.assign(size, {});
  this->Received.assign(size, {});
  std::vector<int> ranks;
  for (std::size_t n = 0; n < count; ++n)
  {
    const NodeIndex node = nodeOf(n);
    domain->ListOwners({ node[0] - margin, node[1] - margin, node[2] - margin },
      { node[0] + margin, node[1] + margin, node[2] + margin }, ranks);
    if (std::find(ranks.begin(), ranks.end(), rank) == ranks.end())
    {
      continue;
    }
    const auto listed = static_cast<std::uint32_t>(this->Listed.size());
    this->Listed.push_back(static_cast<std::uint32_t>(n));
    const int owner = ranks.size() == 1 ? rank : domain->OwnerOf(node);
    this->IsOwnListed.push_back(owner == rank ? 1 : 0);
    if (owner != rank)
    {
      this->Received[static_cast<std::size_t>(owner)].push_back(listed);
      continue;
    }
    for (const int other : ranks)
    {
      if (other != rank)
      {
        this->Sent[static_cast<std::size_t>(other)].push_back(listed);
      }
    }
  }
}

void GhostParticles::SetOrder(const UnsetVector<std::uint32_t>& order)
{
  if (!this->Space)
  {
    return;
  }
  this->Places.resize(order.size());
  this->Own.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    this->Places[order[k]] = static_cast<std::uint32_t>(k);
    this->Own[k] = this->IsOwnListed[order[k]];
  }
}

}
