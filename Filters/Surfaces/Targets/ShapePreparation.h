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

  /** The same for what is a choice of the filter, and nothing wrong. */
  std::function<void(const std::string& reason, const std::string& sentence)> Note;

  /** Usual distance of the particles; 0: not known, and of no use. */
  double GetSpacing() const;

  /** Reach of points without a radius of their own. */
  double GetRadius(ParticleModel model) const;

  /** Reach of a kernel over the radius of the ball that it makes without neighbours. */
  double GetReachPerRadius(ParticleModel model) const;

  /** Usual distance of a frame's particles, of given radii a diameter at the most; 0: it tells
   * none.
   */
  static double FindSpacingOf(const ParticleFrame& frame);

  /** Says which spacing is used, where nothing given tells any length of the particles. */
  void ReportSpacing(bool haveRadii) const;

  /**
   * Gives a frame's particles their reaches, by their radii where they have them. Estimates the
   * spacing from this frame if it is not known; throws std::invalid_argument if no two particles
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
