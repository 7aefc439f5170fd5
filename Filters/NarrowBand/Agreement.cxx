#include "Agreement.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace activesurface
{

namespace
{

constexpr const char* MemoryHasEnded = "There is not enough memory.";

/** State of a rank at the beginning of a round; the largest counts. */
enum State : std::int64_t
{
  Fine = 0,
  Stopping = 1,
  Failed = 2
};

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

std::vector<Bytes> Agreement::Exchange(const Bytes& own) const
{
  this->GoOn(true);
  return this->Ranks->AllGather(own);
}

std::vector<Bytes> Agreement::Distribute(const std::vector<Bytes>& toEach) const
{
  std::vector<std::uint64_t> lengths;
  std::transform(toEach.begin(), toEach.end(), std::back_inserter(lengths),
    [](const Bytes& bytes) { return std::uint64_t(bytes.size()); });
  std::vector<std::size_t> sizes;
  for (const Bytes& ofRank : this->Exchange(ToBytes(lengths)))
  {
    sizes.push_back(FromBytes<std::uint64_t>(ofRank).at(static_cast<std::size_t>(this->GetRank())));
  }
  return this->Ranks->Swap(toEach, sizes);
}

std::vector<Bytes> Agreement::Distribute(
  const std::vector<Bytes>& toEach, const std::vector<std::size_t>& sizes) const
{
  this->GoOn(true);
  return this->Ranks->Swap(toEach, sizes);
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
  const std::int64_t state = this->Ranks->Max(own ? Fine : Stopping);
  if (state == Failed)
  {
    this->ThrowTogether("");
  }
  return state == Fine;
}

void Agreement::Fail(const std::string& sentence) const
{
  this->Ranks->Max(Failed);
  this->ThrowTogether(sentence);
}

void Agreement::FailForMemory() const
{
  this->Fail(MemoryHasEnded);
}

/** Empty: this rank has not failed. */
void Agreement::ThrowTogether(const std::string& sentence) const
{
  const std::vector<Bytes> all = this->Ranks->AllGather({ sentence.begin(), sentence.end() });
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
