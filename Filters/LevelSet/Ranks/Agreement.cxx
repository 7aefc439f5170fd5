#include "Ranks/Agreement.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace activesurface
{

namespace
{

constexpr const char* MemoryHasEnded = "There is not enough memory.";

/** Flags sent instead of a number >= 0 at the beginning of an operation. */
enum State : std::int64_t
{
  Stopping = -1,
  Failed = -2
};

template <class Number>
std::vector<Bytes> MakeRoom(const std::vector<Number>& lengths)
{
  std::vector<Bytes> room;
  room.reserve(lengths.size());
  for (const Number length : lengths)
  {
    room.emplace_back(static_cast<std::size_t>(length));
  }
  return room;
}

}

bool IsOfMemory(const std::exception& error)
{
  return dynamic_cast<const std::bad_alloc*>(&error) ||
    dynamic_cast<const RankMemoryError*>(&error);
}

Agreement::Agreement()
  : Agreement(std::make_shared<SerialCommunicator>())
{
}

Agreement::Agreement(std::shared_ptr<Communicator> ranks)
  : Ranks(std::move(ranks))
{
}

// Begins every operation. Throws if a rank has failed.
std::vector<std::int64_t> Agreement::Begin(std::int64_t own) const
{
  std::vector<std::int64_t> all = this->Ranks->AllGather(own);
  if (std::find(all.begin(), all.end(), Failed) != all.end())
  {
    this->ThrowTogether("");
  }
  return all;
}

// The buffers of a large message may exhaust the memory of one rank, so the ranks check for
// failures again after the allocation of these buffers.
std::vector<Bytes> Agreement::Exchange(const Bytes& own) const
{
  constexpr std::int64_t much = std::int64_t(1) << 20;
  const std::vector<std::int64_t> lengths = this->Begin(static_cast<std::int64_t>(own.size()));
  std::vector<Bytes> all = MakeRoom(lengths);
  if (std::accumulate(lengths.begin(), lengths.end(), std::int64_t(0)) > much)
  {
    this->Begin(0);
  }
  this->Ranks->AllGather(own, all);
  return all;
}

std::vector<Bytes> Agreement::Distribute(std::vector<Bytes> toEach) const
{
  std::vector<std::uint64_t> lengths;
  std::transform(toEach.begin(), toEach.end(), std::back_inserter(lengths),
    [](const Bytes& bytes) { return std::uint64_t(bytes.size()); });
  std::vector<std::size_t> sizes;
  for (const Bytes& ofRank : this->Exchange(ToBytes(lengths)))
  {
    sizes.push_back(FromBytes<std::uint64_t>(ofRank).at(static_cast<std::size_t>(this->GetRank())));
  }
  return this->Distribute(std::move(toEach), sizes);
}

std::vector<Bytes> Agreement::Distribute(
  std::vector<Bytes> toEach, const std::vector<std::size_t>& sizes) const
{
  const auto rank = static_cast<std::size_t>(this->GetRank());
  std::vector<std::size_t> lengths = sizes;
  lengths[rank] = 0;
  std::vector<Bytes> fromEach = MakeRoom(lengths);
  fromEach[rank] = std::move(toEach[rank]);
  this->Begin(0);
  this->Ranks->Swap(toEach, fromEach);
  return fromEach;
}

std::vector<Bytes> Agreement::GatherToFirst(Bytes own) const
{
  std::vector<Bytes> toEach(static_cast<std::size_t>(this->GetSize()));
  toEach.front() = std::move(own);
  std::vector<Bytes> all = this->Distribute(toEach);
  return this->GetRank() == 0 ? all : std::vector<Bytes>();
}

bool Agreement::GoOn(bool own) const
{
  const std::vector<std::int64_t> all =
    this->Begin(own ? std::int64_t{ 0 } : std::int64_t{ Stopping });
  return std::find(all.begin(), all.end(), Stopping) == all.end();
}

void Agreement::Fail(const std::string& sentence) const
{
  this->Ranks->AllGather(Failed);
  this->ThrowTogether(sentence.empty() ? "An error without a description occurred." : sentence);
}

void Agreement::FailForMemory() const
{
  this->Fail(MemoryHasEnded);
}

/** sentence: empty if this rank has not failed. */
void Agreement::ThrowTogether(const std::string& sentence) const
{
  std::vector<Bytes> all =
    MakeRoom(this->Ranks->AllGather(static_cast<std::int64_t>(sentence.size())));
  this->Ranks->AllGather({ sentence.begin(), sentence.end() }, all);
  const auto isSame = [&all](const Bytes& other) { return other == all.front(); };
  const auto first =
    std::find_if(all.begin(), all.end(), [](const Bytes& other) { return !other.empty(); });
  const std::string text(first->begin(), first->end());
  if (text == MemoryHasEnded)
  {
    throw RankMemoryError(text);
  }
  if (std::all_of(all.begin(), all.end(), isSame))
  {
    throw RankError(text);
  }
  throw RankError("On rank " + std::to_string(first - all.begin()) + " of " +
    std::to_string(all.size()) + ": " + text);
}

}
