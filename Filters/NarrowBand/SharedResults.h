/**
 * Results that ranks make together: each a part of them, and each has all in the end.
 */
#ifndef SharedResults_h
#define SharedResults_h

#include "Agreement.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace activesurface
{

/** Counts the bytes of what is passed. */
class ByteCounter
{
public:
  template <class Value>
  void operator()(const Value*, std::size_t count)
  {
    this->Size += count * sizeof(Value);
  }
  std::size_t GetSize() const { return this->Size; }

private:
  std::size_t Size = 0;
};

/** Appends what is passed to bytes. */
class ByteWriter
{
public:
  explicit ByteWriter(Bytes& bytes)
    : Written(bytes)
  {
  }

  template <class Value>
  void operator()(const Value* values, std::size_t count)
  {
    const char* first = reinterpret_cast<const char*>(values);
    this->Written.insert(this->Written.end(), first, first + count * sizeof(Value));
  }

private:
  Bytes& Written;
};

/** Passes a vector of any size. */
template <class Value, class Pass>
void PassVector(std::vector<Value>& values, Pass& pass)
{
  std::size_t size = values.size();
  pass(&size, 1);
  values.resize(size);
  pass(values.data(), size);
}

/** What visit passes of some numbers. */
template <class Number, class Visit>
Bytes WriteResults(const std::vector<Number>& numbers, Visit&& visit)
{
  ByteCounter count;
  for (const Number n : numbers)
  {
    visit(static_cast<std::size_t>(n), count);
  }
  Bytes bytes;
  bytes.reserve(count.GetSize());
  ByteWriter write(bytes);
  for (const Number n : numbers)
  {
    visit(static_cast<std::size_t>(n), write);
  }
  return bytes;
}

/** Sets what is passed from bytes. */
class ByteReader
{
public:
  explicit ByteReader(const Bytes& bytes)
    : Source(bytes)
  {
  }

  template <class Value>
  void operator()(Value* values, std::size_t count)
  {
    const std::size_t size = count * sizeof(Value);
    if (size > this->Source.size() - this->Done)
    {
      throw std::runtime_error("The ranks are not at the same place: one of them has told less "
                               "than the others need. Update all ranks together, with the same "
                               "inputs.");
    }
    if (size > 0) // or values may be null
    {
      std::memcpy(values, this->Source.data() + this->Done, size);
    }
    this->Done += size;
  }

private:
  const Bytes& Source;
  std::size_t Done = 0;
};

/** Ranges of so many results, one for each rank. */
struct RankRanges
{
  std::size_t Count;
  std::size_t Ranks;

  std::size_t FirstOf(std::size_t rank) const
  {
    return this->Count / this->Ranks * rank + std::min(rank, this->Count % this->Ranks);
  }

  /** The numbers of those of a rank that are told in a round. */
  std::vector<std::size_t> ListRound(std::size_t rank, std::size_t round) const
  {
    const std::size_t end = this->FirstOf(rank + 1);
    const std::size_t first = std::min(this->FirstOf(rank) + round * InRound, end);
    std::vector<std::size_t> numbers(std::min(InRound, end - first));
    std::iota(numbers.begin(), numbers.end(), first);
    return numbers;
  }

  std::size_t CountRounds() const { return (this->FirstOf(1) + InRound - 1) / InRound; }

private:
  static constexpr std::size_t InRound = 16384; //< so that messages take little memory
};

/** Each rank makes its range of so many results, by make(first, end), and is told the others;
 * visit(number, pass) names what a result is, by pass(values, count). Without ranks, all are made.
 */
template <class Make, class Visit>
void ShareResults(Agreement* ranks, std::size_t count, Make&& make, Visit&& visit)
{
  if (!ranks || ranks->IsAlone())
  {
    make(std::size_t{ 0 }, count);
    return;
  }
  const RankRanges ranges{ count, static_cast<std::size_t>(ranks->GetSize()) };
  const auto own = static_cast<std::size_t>(ranks->GetRank());
  make(ranges.FirstOf(own), ranges.FirstOf(own + 1));
  for (std::size_t round = 0; round < ranges.CountRounds(); ++round)
  {
    const std::vector<Bytes> all =
      ranks->Exchange(WriteResults(ranges.ListRound(own, round), visit));
    for (std::size_t rank = 0; rank < ranges.Ranks; ++rank)
    {
      ByteReader read(all[rank]);
      for (const std::size_t n :
        rank != own ? ranges.ListRound(rank, round) : std::vector<std::size_t>())
      {
        visit(n, read);
      }
    }
  }
}

/** What each rank has, by rank; visit(value, pass) names what it is. */
template <class Value, class Visit>
std::vector<Value> GatherResults(Agreement& ranks, const Value& own, Visit&& visit)
{
  std::vector<Value> all(static_cast<std::size_t>(ranks.GetSize()));
  ShareResults(
    &ranks, all.size(), [&](std::size_t rank, std::size_t) { all[rank] = own; },
    [&](std::size_t rank, auto& pass) { visit(all[rank], pass); });
  return all;
}

}

#endif
