/**
 * What one substep passes from hand to hand; kept from substep to substep for its memory.
 */
#ifndef SubstepBuffers_h
#define SubstepBuffers_h

#include "LeafMask.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

/** Makes a vector so long. Where it has to grow, what it holds is lost, so that memory is never
 * needed twice. */
template <class Value>
void MakeRoom(std::vector<Value>& room, std::size_t size)
{
  if (room.capacity() < size)
  {
    std::vector<Value>().swap(room);
    room.reserve(size + size / 8); // surfaces that grow do so by little
  }
  room.resize(size);
}

struct SubstepBuffers
{
  // F - iso at the points of evaluation, leaf by leaf.
  std::vector<float> Samples;
  static constexpr std::int64_t NoSamples = -1; //< of a leaf that has not been sampled
  std::vector<std::int64_t> FirstSample;        //< number of a leaf's first point

  // Per leaf, 512 nodes each: extended target speed, valid where Known, then the potential after
  // the substep, which takes its room row by row.
  std::vector<float> Nodes;
  std::vector<LeafMask> Known;
  std::vector<LeafMask> NextKnown;

  // Per leaf.
  std::vector<double> LargestSlope; //< of the target, |dF/dn|
  std::vector<float> LargestSpeed;  //< at the nodes with samples
  std::vector<int> FlatNodes;       //< layer 0 nodes of slope below 1/sqrt 2
  std::vector<int> SteepNodes;      //< layer 0 nodes of slope above sqrt 2

  void MakeRoomForNodes(std::size_t leaves) { MakeRoom(this->Nodes, 512 * leaves); }
  float* SpeedOf(std::size_t leaf) { return this->Nodes.data() + 512 * leaf; }
  const float* SpeedOf(std::size_t leaf) const { return this->Nodes.data() + 512 * leaf; }
  float* NextOf(std::size_t leaf) { return this->Nodes.data() + 512 * leaf; }
  const float* NextOf(std::size_t leaf) const { return this->Nodes.data() + 512 * leaf; }
};

}

#endif
