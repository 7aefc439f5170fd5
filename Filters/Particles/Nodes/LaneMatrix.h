// Symmetric 3 x 3 matrices, eight in SIMD lanes.

#ifndef LaneMatrix_h
#define LaneMatrix_h

#include "Base/FloatLanes.h"

namespace activesurface
{

// Entries: xx xy xz yy yz zz.
struct LaneMatrix
{
  Lanes Entry[6];

  static constexpr int At[3][3] = { { 0, 1, 2 }, { 1, 3, 4 }, { 2, 4, 5 } };

  ACTIVE_ALWAYS_INLINE Lanes& Of(int i, int k) { return this->Entry[At[i][k]]; }
};

// Eigenvalues, largest first, and their eigenvectors in columns.
struct LaneEigen
{
  Lanes Value[3];
  Lanes Vector[3][3];

  // Five sweeps of Jacobi rotations.
  ACTIVE_ALWAYS_INLINE explicit LaneEigen(const LaneMatrix& given)
  {
    LaneMatrix matrix = given;
    for (int i = 0; i < 3; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        this->Vector[i][k] = AllLanes(i == k ? 1.f : 0.f);
      }
    }
    constexpr int sweeps = 5;
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
      this->Rotate(matrix, 0, 1);
      this->Rotate(matrix, 0, 2);
      this->Rotate(matrix, 1, 2);
    }
    for (int i = 0; i < 3; ++i)
    {
      this->Value[i] = matrix.Of(i, i);
    }
    this->Order(0, 1);
    this->Order(1, 2);
    this->Order(0, 1);
  }

private:
  // Makes the entry (p, q) 0.
  ACTIVE_ALWAYS_INLINE void Rotate(LaneMatrix& a, int p, int q)
  {
    const Lanes one = AllLanes(1.f), zero = AllLanes(0.f);
    constexpr float precision = 1e-12f, least = 1e-30f;
    const Lanes app = a.Of(p, p), aqq = a.Of(q, q), apq = a.Of(p, q);
    const LaneMask isTiny =
      Size(apq) < AllLanes(precision) * (Size(app) + Size(aqq)) + AllLanes(least);
    const Lanes theta = (aqq - app) / (AllLanes(2.f) * Pick(isTiny, one, apq));
    const Lanes sign = Pick(theta < zero, -one, one);
    const Lanes tangent = Pick(isTiny, zero, sign / (Size(theta) + Root(theta * theta + one)));
    const Lanes cosine = one / Root(tangent * tangent + one), sine = tangent * cosine;
    const int r = 3 - p - q;
    const Lanes arp = a.Of(r, p), arq = a.Of(r, q);
    a.Of(r, p) = cosine * arp - sine * arq;
    a.Of(r, q) = sine * arp + cosine * arq;
    a.Of(p, p) = app - tangent * apq;
    a.Of(q, q) = aqq + tangent * apq;
    a.Of(p, q) = zero;
    for (int k = 0; k < 3; ++k)
    {
      const Lanes vp = this->Vector[k][p], vq = this->Vector[k][q];
      this->Vector[k][p] = cosine * vp - sine * vq;
      this->Vector[k][q] = sine * vp + cosine * vq;
    }
  }

  ACTIVE_ALWAYS_INLINE void Order(int i, int k)
  {
    const LaneMask isLess = this->Value[i] < this->Value[k];
    Swap(isLess, this->Value[i], this->Value[k]);
    for (int row = 0; row < 3; ++row)
    {
      Swap(isLess, this->Vector[row][i], this->Vector[row][k]);
    }
  }

  static ACTIVE_ALWAYS_INLINE void Swap(const LaneMask& condition, Lanes& a, Lanes& b)
  {
    const Lanes was = a;
    a = Pick(condition, b, a);
    b = Pick(condition, was, b);
  }
};

}

#endif
