/**
 * Normal speeds of the skin of the node scheme.
 *
 * With psi_b and psi_e the distances to the target at the begin and the end of a frame, D the mean
 * displacement of its particles at a vertex, which has gone the share f of the way, the speed is
 *   (D . n - r (psi_e(x + (1 - f) D) - psi_b(x - f D))) / (end - begin):
 * what moves with the particles, and what grows or shrinks beside that. r is the share of a change
 * that the skin follows in a frame, which is small within the target's noise.
 */
#ifndef NodeSpeeds_h
#define NodeSpeeds_h

#include <vector>

namespace activesurface
{

class NarrowBand;
struct SkinForces;

/** Adds them to the speeds of the vertices [length/time]; nothing if the frame has no duration. */
void AddNodeSpeeds(const NarrowBand& band, const SkinForces& forces, std::vector<float>& speeds);

}

#endif
