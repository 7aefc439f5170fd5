// Finds the fraction of a surface that belongs to sheets, rods and crumbs thinner than a length.
//
// The body is thin at a surface point if the function is positive on both sides along the normal,
// within that length. One such point is outside, the other behind the opposite side of the body.
// The test needs no distances, no resolution of the part and no oriented normals. The function has
// to rise along the normal to within 45 degrees, so that the opposite side faces the point. Edges
// of a cube, or of any wedge of more than 45 degrees, are therefore not thin: they are rounded off,
// but not lost.

#ifndef ThinParts_h
#define ThinParts_h

namespace activesurface
{

class GridSamples;
struct SurfaceSample;

// Returns the fraction of the area, 0 to 1, of parts thinner than `thickness`; 0 without points.
double FindThinShare(const GridSamples& function, const SurfaceSample& surface, double thickness);

}

#endif
