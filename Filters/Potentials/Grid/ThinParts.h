// Which part of a surface belongs to sheets, rods and crumbs that are thinner than a length.
//
// At a point of the surface the body is thin if the function is positive, and rises on the way, on
// both sides of it, somewhere within that length along the normal: outside, and behind the other
// side of the body. That needs no distances, no resolution of the part and no oriented normals. On
// the way in, the function has to rise along the way to within 45 degrees: the other side faces the
// point. So the edges of a cube, or of any wedge of more than 45 degrees, are not thin: they are
// rounded off, but not lost.

#ifndef ThinParts_h
#define ThinParts_h

namespace activesurface
{

class GridSamples;
struct SurfaceSample;

// The share of the area, 0 to 1, of parts that are thinner than `thickness`; 0 without points.
double FindThinShare(const GridSamples& function, const SurfaceSample& surface, double thickness);

}

#endif
