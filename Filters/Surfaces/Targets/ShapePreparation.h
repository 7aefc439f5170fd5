/** Arguments and results of InputShape::Prepare. */
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
  double& EstimatedSpacing; //< for all time steps [length]; 0: no estimate yet
  std::string When;         //< "at the time step 2", for messages

  bool IsDomainKnown = false; //< otherwise voxel size and reach are undefined
  double Reach = 0.0;         //< width around a mesh in which distances are needed [length]
  double MaximumVoxels = 0.0; //< limit for the distances to a mesh [voxels]
  std::string MeshHint;       //< appended to each error of a mesh; explains Reach and MaximumVoxels

  /** Warns the user, once for each reason. */
  std::function<void(const std::string& reason, const std::string& sentence)> Report;

  /** Informs the user of a choice of the filter, once for each reason. */
  std::function<void(const std::string& reason, const std::string& sentence)> Note;

  /**
   * Typical distance of the particles: ParticleSpacing or the estimate; 0 if unknown or not needed.
   */
  double GetSpacing() const;

  /** Support radius of points without a radius of their own. */
  double GetRadius(ParticleModel model) const;

  /**
   * Support radius of an isolated particle's kernel, divided by the radius of the particle's ball.
   */
  double GetReachPerRadius(ParticleModel model) const;

  /**
   * Returns the typical distance of a frame's particles. With radii: at most the median diameter.
   * If all particles coincide: the median diameter, or 0 without radii.
   */
  static double FindSpacingOf(const ParticleFrame& frame, const PeriodicBox& box);

  /** Reports the estimated spacing unless radii or KernelRadius are given. */
  void ReportSpacing(bool haveRadii) const;

  /**
   * Sets the support radii of a frame's particles, from their radii if there are any. Estimates the
   * spacing from this frame if the spacing is needed and has not been estimated. Throws
   * std::invalid_argument if all particles coincide and there are neither radii nor a KernelRadius.
   */
  void GiveRadius(ParticleModel model, ParticleFrame& frame);

private:
  void EstimateSpacing(ParticleModel model, const ParticleFrame& frame);
};

/**
 * Prepares a shape. Returns a message about defects, or an empty string. Throws std::runtime_error
 * if the shape is unusable. Messages begin with `where`.
 */
std::string PrepareShape(
  InputShape& shape, ShapePreparation& preparation, const std::string& where);

}

#endif
