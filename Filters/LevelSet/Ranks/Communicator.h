/**
 * Ranks of a parallel program and their collective operations. Every rank has to make the same
 * calls in the same order.
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

  /** Rank of this process, in [0, GetSize()). */
  virtual int GetRank() const = 0;
  virtual int GetSize() const = 0;

  /** Collective. Returns `own` of each rank, by rank. */
  virtual std::vector<std::int64_t> AllGather(std::int64_t own) = 0;

  /** Collective. Copies `own` of each rank to `all`, by rank. The elements of `all` have to have
   * the sizes of the messages. */
  virtual void AllGather(const Bytes& own, std::vector<Bytes>& all) = 0;

  /** Collective. Sends toEach[rank] to each other rank, and receives fromEach[rank] from that rank.
   * The elements of fromEach have to have the sizes of the messages. Empty messages are not sent.
   */
  virtual void Swap(const std::vector<Bytes>& toEach, std::vector<Bytes>& fromEach) = 0;
};

/** A program of one process. */
class SerialCommunicator final : public Communicator
{
public:
  int GetRank() const override { return 0; }
  int GetSize() const override { return 1; }
  std::vector<std::int64_t> AllGather(std::int64_t own) override { return { own }; }
  void AllGather(const Bytes& own, std::vector<Bytes>& all) override { all = { own }; }
  void Swap(const std::vector<Bytes>&, std::vector<Bytes>&) override {}
};

}

#endif
