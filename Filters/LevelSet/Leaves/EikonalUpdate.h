/**
 * The second-order eikonal update of a node. a is the distance at the node [voxels]. a1 and a2 are
 * the distances at the nodes one and two steps away along each axis, on the nearer side; distances
 * beyond the surface are negative:
 *
 *   sum of w^2 (a - t)^2 = 1,   t = (4 a1 - a2) / 3, w = 3/2 if there is an a2 <= a1,
 *                               else t = a1, w = 1
 *
 * where the sum is over the axes with t < a, from which the wave comes.
 */
#ifndef EikonalUpdate_h
#define EikonalUpdate_h

#include "Base/CompilerBuiltins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace activesurface
{

/** One axis of the eikonal equation: weight * (a - known). */
struct UpwindTerm
{
  double Known;
  double Weight;
};

ACTIVE_ALWAYS_INLINE UpwindTerm FirstOrderTerm(double a1)
{
  return { a1, 1.0 };
}

/** Returns the term of second order if a2 <= a1, otherwise the term of first order. */
ACTIVE_ALWAYS_INLINE UpwindTerm SecondOrderTerm(double a1, double a2)
{
  return a2 <= a1 ? UpwindTerm{ (4.0 * a1 - a2) / 3.0, 1.5 } : FirstOrderTerm(a1);
}

/** Solves for a. Uses, in ascending order, the terms whose values are below a. Sorts the terms. */
ACTIVE_ALWAYS_INLINE double SolveEikonal(std::array<UpwindTerm, 3>& terms, int count)
{
  for (int i = 1; i < count; ++i)
  {
    for (int j = i; j > 0 && terms[j].Known < terms[j - 1].Known; --j)
    {
      std::swap(terms[j], terms[j - 1]);
    }
  }
  double solution = 0.0, squares = 0.0, linear = 0.0, constant = -1.0;
  for (int i = 0; i < count; ++i)
  {
    const auto [known, weight] = terms[i];
    if (i > 0 && !(known < solution))
    {
      break;
    }
    squares += weight * weight;
    linear += weight * weight * known;
    constant += weight * weight * known * known;
    const double root = std::max(linear * linear - squares * constant, 0.0);
    solution = (linear + std::sqrt(root)) / squares;
  }
  return solution;
}

}

#endif
