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

class InputShape;
struct ParticleFrame;

struct ShapePreparation
{
  ShapePreparation(const ShapeOptions& options, double& estimatedSpacing)
    : Options(options)
    , EstimatedSpacing(estimatedSpacing)
  {
  }

  ShapeOptions Options;
  double& EstimatedSpacing; //< of all time steps [length]; 0: there is no estimate yet
  std::string When;         //< "at the time step 2", for messages

  bool IsDomainKnown = false; //< else voxel size and reach are not
  double Reach = 0.0;         //< how far around its surface a mesh has to be known [length]
  double MaximumVoxels = 0.0; //< that the distances to a mesh may take
  std::string MeshHint;       //< what the error of a mesh that would take more adds

  /** Warns a user, once for each reason. */
  std::function<void(const std::string& reason, const std::string& sentence)> Report;

  /** Informs a user of a choice of the filter, once for each reason. */
  std::function<void(const std::string& reason, const std::string& sentence)> Note;

  /** Usual distance of the particles; 0: not known, and of no use. */
  double GetSpacing() const;

  /** Reach of points without a radius of their own. */
  double GetRadius(ParticleModel model) const;

  /** Reach of a kernel over the radius of the ball that it makes without neighbours. */
  double GetReachPerRadius(ParticleModel model) const;

  /** Returns the usual distance of a frame's particles, at most a diameter if radii are given; 0 if
   * no two are apart. */
  static double FindSpacingOf(const ParticleFrame& frame, const PeriodicBox& box);

  /** Reports the spacing in use if neither a spacing, a reach nor radii are given. */
  void ReportSpacing(bool haveRadii) const;

  /**
   * Gives a frame's particles their reaches, by their radii where they have them. Estimates the
   * spacing from this frame if there is none yet; throws std::invalid_argument if no two particles
   * are apart and there is no radius either.
   */
  void GiveRadius(ParticleModel model, ParticleFrame& frame);

private:
  void EstimateSpacing(ParticleModel model, const ParticleFrame& frame);
};

/** Returns what is wrong with the shape, and throws why it cannot be used (std::runtime_error), in
 * a sentence that begins with where it is from. */
std::string PrepareShape(
  InputShape& shape, ShapePreparation& preparation, const std::string& where);

}

#endif
