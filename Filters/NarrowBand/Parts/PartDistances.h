/**
 * Distances in the layers of a band, from its signs and a function.
 *
 * They are the function's first-order distances |F| / |grad F|, by central differences: exact for
 * distances, smooth where F is smooth. Where F is neither, within half of the distances to its
 * crossings on the edges, which an eikonal update (EikonalUpdate.h) takes from node to node. Only
 * nodes of earlier rounds are used, so the order within a round does not matter.
 */
#ifndef PartDistances_h
#define PartDistances_h

#include "Leaves/LeafTable.h"
#include "Parts/LatticeFunction.h"

#include <memory>
#include <vector>

namespace activesurface
{

class PartDistances
{
public:
  explicit PartDistances(LeafTable& table);

  /** Sets the values of all nodes in the layers. The function's signs are those of the table. */
  void Find(const LatticeFunction& function);

private:
  void SampleAll(const LatticeFunction& function);
  void Sample(const LatticeFunction& function, std::size_t i);
  void StartAtCrossings(std::size_t i);
  float DistanceToCrossings(std::size_t i, int node) const;
  /** One round; false if all nodes of the layers are known. */
  bool Extend();
  bool ExtendLeaf(std::size_t i);
  LeafMask FindFront(std::size_t i) const;
  float SolveEikonal(std::size_t i, int node) const;
  void UseFunction(std::size_t i);
  float FirstOrderDistance(std::size_t i, int node) const;

  bool IsKnown(const LeafTable::Place& place) const
  {
    return place.Leaf >= 0 && this->Known[place.Leaf].Has(place.Node);
  }
  float MagnitudeAt(const LeafTable::Place& place) const;

  LeafTable& Table;
  std::vector<std::unique_ptr<double[]>> Function; // |F| in the layers, negative inside
  std::vector<LeafMask> Known;
  std::vector<LeafMask> NextKnown;
};

}

#endif
