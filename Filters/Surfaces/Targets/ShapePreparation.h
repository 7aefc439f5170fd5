/**
 * What a shape is prepared with before it is used: see InputShape::Prepare.
 */
#ifndef ShapePreparation_h
#define ShapePreparation_h

#include "Targets/ShapeOptions.h"

#include <functional>
#include <string>

namespace activesurface
{

struct ParticleFrame;

struct ShapePreparation
{
  ShapePreparation(const ShapeOptions& options, double& estimatedRadius)
    : Options(options)
    , EstimatedRadius(estimatedRadius)
  {
  }

  ShapeOptions Options;
  double& EstimatedRadius; //< of all time steps [length]; 0: there is no estimate yet
  std::string When;        //< "at the time step 2", for messages

  bool IsDomainKnown = false; //< else voxel size and reach are not
  double Reach = 0.0;         //< how far around its surface a mesh has to be known [length]
  std::string ReachHint;      //< what the error of a mesh that cannot be known so far adds

  /** Tells a user something, once for each reason. */
  std::function<void(const std::string& reason, const std::string& sentence)> Report;

  /** Of points without a radius of their own. */
  double GetRadius() const;

  /**
   * Gives that radius to a frame's particles, unless they have radii. Estimates it from the first
   * frame that needs it; throws std::invalid_argument if no two particles are apart.
   */
  void GiveRadius(ParticleFrame& frame);
};

}

#endif
