/**
 * Schemes of OpenVDB's level set tools for the comparison: their defaults, and the cheapest.
 */
#ifndef OpenVDBSchemes_h
#define OpenVDBSchemes_h

#include <openvdb/tools/LevelSetFilter.h>
#include <openvdb/tools/LevelSetMorph.h>

#include <string>

namespace activesurface
{

/** HJWENO5_BIAS everywhere, TVD_RK1 for three renormalisations a step, TVD_RK2 to morph. */
constexpr bool Default = false;
/** FIRST_BIAS and TVD_RK1 everywhere, one renormalisation a step. */
constexpr bool Cheapest = true;

inline std::string NameOf(bool isCheapest)
{
  return isCheapest ? "OpenVDB, cheapest" : "OpenVDB, defaults";
}

template <class Grid>
void ChooseScheme(openvdb::tools::LevelSetFilter<Grid>& filter, bool isCheapest)
{
  if (isCheapest)
  {
    filter.setSpatialScheme(openvdb::math::FIRST_BIAS);
    filter.setTemporalScheme(openvdb::math::TVD_RK1);
    filter.setNormCount(1);
  }
}

template <class Grid>
void ChooseScheme(openvdb::tools::LevelSetMorphing<Grid>& morphing, bool isCheapest)
{
  if (isCheapest)
  {
    morphing.setSpatialScheme(openvdb::math::FIRST_BIAS);
    morphing.setTemporalScheme(openvdb::math::TVD_RK1);
    morphing.setTrackerSpatialScheme(openvdb::math::FIRST_BIAS);
    morphing.setTrackerTemporalScheme(openvdb::math::TVD_RK1);
    morphing.setNormCount(1);
  }
}

}

#endif
