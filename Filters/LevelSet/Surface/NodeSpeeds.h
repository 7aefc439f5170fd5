/**
 * Normal speeds of the skin in the node scheme.
 *
 * psi_b and psi_e are the distances to the target at the begin and the end of a frame, D is the
 * mean displacement of the particles at a vertex, and f the elapsed fraction of the frame. The
 * speed is
 *   (D . n - r (psi_e(x + (1 - f) D) - psi_b(x - f D))) / (end - begin):
 * the motion with the particles, and growth or shrinkage. r is the fraction of a change that the
 * skin follows in a frame; it is small within the target's noise.
 */
#ifndef NodeSpeeds_h
#define NodeSpeeds_h

#include <vector>

namespace activesurface
{

class NarrowBand;
struct SkinForces;

/** Adds the speeds at the vertices [length/time]. Adds nothing if the frame has no duration. */
void AddNodeSpeeds(const NarrowBand& band, const SkinForces& forces, std::vector<float>& speeds);

}

#endif
