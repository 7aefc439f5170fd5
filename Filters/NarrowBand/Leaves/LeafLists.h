/**
 * Sets of leaves, as ascending lists.
 */
#ifndef LeafLists_h
#define LeafLists_h

#include "Leaves/LeafTable.h"

#include <algorithm>
#include <iterator>

namespace activesurface
{

inline LeafList Without(const LeafList& leaves, const LeafList& others)
{
  LeafList rest;
  std::set_difference(
    leaves.begin(), leaves.end(), others.begin(), others.end(), std::back_inserter(rest));
  return rest;
}

inline LeafList Intersection(const LeafList& leaves, const LeafList& others)
{
  LeafList common;
  std::set_intersection(
    leaves.begin(), leaves.end(), others.begin(), others.end(), std::back_inserter(common));
  return common;
}

}

#endif
