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

  /** Returns the number of each rank, by rank. Collective. */
  virtual std::vector<std::int64_t> AllGather(std::int64_t own) = 0;

  /** Puts the bytes of each rank, by rank, where there is room for as many. Collective. */
  virtual void AllGather(const Bytes& own, std::vector<Bytes>& all) = 0;

  /** Sends bytes to each other rank, and puts those that each of them has sent where there is room
   * for as many. Nothing is sent where there are none. Collective. */
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
