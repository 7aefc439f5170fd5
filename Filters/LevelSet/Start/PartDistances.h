/**
 * Distances in the layers of a band, from its signs and a function.
 *
 * A distance is the function's first-order distance |F| / |grad F|, by central differences. It is
 * exact for distances and smooth where F is smooth. It is limited to half to one and a half times
 * the distance to the crossings on edges. An eikonal update (EikonalUpdate.h) propagates this
 * distance from node to node. A sweep uses only nodes of earlier sweeps, so the order within a
 * sweep does not matter.
 */
#ifndef PartDistances_h
#define PartDistances_h

#include "Leaves/LeafTable.h"
#include "Start/LatticeFunction.h"

#include <memory>
#include <vector>

namespace activesurface
{

class PartDistances
{
public:
  explicit PartDistances(LeafTable& table);

  /**
   * Sets the values of all nodes in the layers. The function's signs have to be those of the table.
   */
  void Find(const LatticeFunction& function);

private:
  void SampleAll(const LatticeFunction& function);
  void Sample(const LatticeFunction& function, std::size_t i);
  void StartAtCrossings(std::size_t i);
  float DistanceToCrossings(std::size_t i, int node) const;
  /** Runs one sweep. Returns false if all nodes of the layers are known. */
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
