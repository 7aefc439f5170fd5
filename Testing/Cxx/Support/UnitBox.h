/**
 * Where the exact tests and the benchmarks take place, and the plainest motion there.
 */
#ifndef UnitBox_h
#define UnitBox_h

#include "Motion.h"

#include <cstdlib>
#include <string>

namespace activesurface
{
/** [-1,1]^3. */
constexpr double Box[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };

/** For n nodes along each side of Box. */
constexpr double VoxelSizeOf(int n)
{
  return 2.0 / (n - 1);
}

/** How the exact tests integrate time: each runs once for either way, as ctest says. */
inline TimeIntegration IntegrationUnderTest()
{
  const char* wanted = std::getenv("ACTIVE_TEST_INTEGRATION");
  return wanted && std::string(wanted) == "implicit" ? TimeIntegration::Implicit
                                                     : TimeIntegration::Explicit;
}

inline Motion MakeMotion(double attraction, double tension)
{
  Motion motion;
  motion.Integration = IntegrationUnderTest();
  motion.Attraction = attraction;
  motion.Tension = tension;
  return motion;
}

inline Motion MakeImplicit(double attraction, double tension)
{
  Motion motion = MakeMotion(attraction, tension);
  motion.Integration = TimeIntegration::Implicit;
  return motion;
}
}

#endif
