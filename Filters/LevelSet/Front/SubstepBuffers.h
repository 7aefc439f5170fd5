/**
 * Data that the passes of a substep exchange. The memory is kept between substeps.
 */
#ifndef SubstepBuffers_h
#define SubstepBuffers_h

#include "Leaves/LeafMask.h"
#include "Leaves/NodeArrays.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

/**
 * Resizes a vector. If the vector needs new memory, its contents are lost, so that the old and new
 * memory never coexist.
 */
template <class Value>
void MakeRoom(std::vector<Value>& room, std::size_t size)
{
  if (room.capacity() < size)
  {
    std::vector<Value>().swap(room);
    room.reserve(size + size / 8); // avoids reallocation while a surface grows
  }
  room.resize(size);
}

struct SubstepBuffers
{
  // F - iso at the evaluation points, leaf by leaf.
  std::vector<float> Samples;
  static constexpr std::int64_t NoSamples = -1; //< of an unsampled leaf
  std::vector<std::int64_t> FirstSample;        //< index of a leaf's first point

  // Per leaf, 512 nodes each: the target speed at nodes with samples and at other Known nodes, 0
  // elsewhere. The potential after the substep overwrites the speed row by row.
  NodeArrays Nodes;
  std::vector<LeafMask> Known;
  std::vector<LeafMask> NextKnown;

  // Per leaf.
  std::vector<double> LargestTargetSlope; //< |dF/dn|
  std::vector<float> LargestSpeed;        //< at the nodes with samples
  std::vector<int> FlatNodes;             //< layer 0 nodes of gradient norm below 1/sqrt 2
  std::vector<int> SteepNodes;            //< layer 0 nodes of gradient norm above sqrt 2
  std::vector<std::uint8_t> Unbounded;    //< see GradientCounts

  void MakeRoomForCounts(std::size_t leaves)
  {
    this->FlatNodes.resize(leaves);
    this->SteepNodes.resize(leaves);
    this->Unbounded.resize(leaves);
  }
  void MakeRoomForNodes(std::size_t leaves) { this->Nodes.MakeRoom(leaves); }
  float* SpeedOf(std::size_t leaf) { return this->Nodes.Of(leaf); }
  const float* SpeedOf(std::size_t leaf) const { return this->Nodes.Of(leaf); }
  float* NextOf(std::size_t leaf) { return this->Nodes.Of(leaf); }
  const float* NextOf(std::size_t leaf) const { return this->Nodes.Of(leaf); }
};

}

#endif
