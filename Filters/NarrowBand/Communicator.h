/**
 * Ranks of a parallel program and their collective operations: every rank makes the same calls in
 * the same order.
 */
#ifndef Communicator_h
#define Communicator_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

using Bytes = std::vector<char>;

class Communicator
{
public:
  Communicator() = default;
  Communicator(const Communicator&) = delete;
  void operator=(const Communicator&) = delete;
  virtual ~Communicator() = default;

  /** In [0, GetSize()). */
  virtual int GetRank() const = 0;
  virtual int GetSize() const = 0;

  /** Returns the largest of the ranks' numbers. Collective. */
  virtual std::int64_t Max(std::int64_t own) = 0;

  /** Returns the bytes of each rank, by rank. Collective. */
  virtual std::vector<Bytes> AllGather(const Bytes& own) = 0;

  /** Sends bytes to each rank, and returns those that each has sent to this one, by rank. sizes:
   * how many come from each. Nothing is sent where there are none. Collective. */
  virtual std::vector<Bytes> Swap(
    const std::vector<Bytes>& toEach, const std::vector<std::size_t>& sizes) = 0;
};

/** A program of one process. */
class SerialCommunicator final : public Communicator
{
public:
  int GetRank() const override { return 0; }
  int GetSize() const override { return 1; }
  std::int64_t Max(std::int64_t own) override { return own; }
  std::vector<Bytes> AllGather(const Bytes& own) override { return { own }; }
  std::vector<Bytes> Swap(
    const std::vector<Bytes>& toEach, const std::vector<std::size_t>&) override
  {
    return toEach;
  }
};

}

#endif
