#include "Nodes/NodeHalo.h"

#include "Ranks/Domain.h"
#include "Ranks/RankBytes.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace activesurface
{

namespace
{

constexpr std::size_t BytesOfLeaf = 512 * sizeof(float);

}

std::size_t NodeHalo::Find(const Domain* domain, std::vector<ShellLeaf>& shell)
{
  this->Space = domain;
  if (!domain)
  {
    return shell.size();
  }
  shell.erase(std::remove_if(shell.begin(), shell.end(),
                [domain](const ShellLeaf& leaf) { return !domain->IsOwn(leaf.Origin); }),
    shell.end());
  const std::size_t own = shell.size();
  this->ListSent(shell);
  std::vector<Bytes> toEach;
  toEach.reserve(this->Sent.size());
  for (const std::vector<std::size_t>& leaves : this->Sent)
  {
    std::vector<NodeIndex> origins;
    origins.reserve(leaves.size());
    for (const std::size_t i : leaves)
    {
      origins.push_back(shell[i].Origin);
    }
    toEach.push_back(ToBytes(origins));
  }
  this->Received.clear();
  for (const Bytes& bytes : domain->GetRanks().Distribute(std::move(toEach)))
  {
    std::vector<std::size_t> leaves;
    for (const NodeIndex& origin : FromBytes<NodeIndex>(bytes))
    {
      leaves.push_back(shell.size());
      shell.push_back({ origin, 0, 0 });
    }
    this->Received.push_back(leaves);
  }
  return own;
}

void NodeHalo::ListSent(const std::vector<ShellLeaf>& own)
{
  this->Sent.assign(static_cast<std::size_t>(this->Space->GetRanks().GetSize()), {});
  std::vector<int> others;
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    this->Space->ListOthersAround(own[i].Origin, others);
    for (const int other : others)
    {
      this->Sent[static_cast<std::size_t>(other)].push_back(i);
    }
  }
}

void NodeHalo::Refresh(const NodeArrays& numbers) const
{
  if (!this->Space)
  {
    return;
  }
  std::vector<Bytes> toEach;
  toEach.reserve(this->Sent.size());
  for (const std::vector<std::size_t>& leaves : this->Sent)
  {
    Bytes bytes(leaves.size() * BytesOfLeaf);
    for (std::size_t k = 0; k < leaves.size(); ++k)
    {
      std::memcpy(bytes.data() + k * BytesOfLeaf, numbers.Of(leaves[k]), BytesOfLeaf);
    }
    toEach.push_back(std::move(bytes));
  }
  std::vector<std::size_t> sizes;
  sizes.reserve(this->Received.size());
  for (const std::vector<std::size_t>& leaves : this->Received)
  {
    sizes.push_back(leaves.size() * BytesOfLeaf);
  }
  const std::vector<Bytes> fromEach = this->Space->GetRanks().Distribute(std::move(toEach), sizes);
  for (std::size_t rank = 0; rank < fromEach.size(); ++rank)
  {
    for (std::size_t k = 0; k < this->Received[rank].size(); ++k)
    {
      std::memcpy(
        numbers.Of(this->Received[rank][k]), fromEach[rank].data() + k * BytesOfLeaf, BytesOfLeaf);
    }
  }
}

}
