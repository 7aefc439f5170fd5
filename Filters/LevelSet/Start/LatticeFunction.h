/**
 * Evaluates a function at nodes of the lattice.
 */
#ifndef LatticeFunction_h
#define LatticeFunction_h

#include "Base/InitialFunction.h"
#include "Leaves/LeafMask.h"
#include "Start/LatticeBox.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cstddef>
#include <vector>

namespace activesurface
{

class LatticeFunction
{
public:
  /** The caller owns the function and the limits. At nodes on or beyond the faces of the limits,
   * values are replaced by their magnitudes. Without limits values are not replaced. */
  LatticeFunction(
    double voxelSize, const InitialFunction& function, const LatticeBox* limits = nullptr)
    : VoxelSize(voxelSize)
    , Function(function)
    , Limits(limits)
  {
  }

  /**
   * Evaluates the function at `nodes` of the leaf at an origin. Values at other nodes of the leaf
   * are not written.
   */
  void Evaluate(const openvdb::Coord& origin, const LeafMask& nodes, double* values) const;

  /** Returns the nodes at which the function is negative. NaN is outside. */
  LeafMask FindInside(const openvdb::Coord& origin, const LeafMask& nodes) const;

  /** Evaluates the function at single nodes. */
  void Evaluate(const std::vector<openvdb::Coord>& nodes, std::vector<double>& values) const;

  /** Calls function(i) for i = begin..end - 1, in parallel if InitialFunction::ThreadSafe. */
  template <class Function>
  void ForEach(std::size_t begin, std::size_t end, Function&& function) const
  {
    if (!this->Function.ThreadSafe)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        function(i);
      }
      return;
    }
    tbb::parallel_for(begin, end, [&function](std::size_t i) { function(i); });
  }

  /** Number of evaluations; a node may be evaluated several times. */
  std::size_t CountEvaluations() const { return this->Evaluations.load(); }

private:
  void EvaluateNodes(std::size_t count, const openvdb::Coord* nodes, double* values) const;

  const double VoxelSize;
  const InitialFunction& Function;
  const LatticeBox* const Limits;
  mutable std::atomic<std::size_t> Evaluations{ 0 };
};

}

#endif
