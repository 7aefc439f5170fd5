/**
 * The input at one time step, as one kind of target. Each kind is a class in its own file.
 * InputKinds.cxx lists the kinds.
 */
#ifndef InputShape_h
#define InputShape_h

#include <array>
#include <cstdint>
#include <memory>
#include <string>

class vtkBoundingBox;
class vtkImplicitFunction;

namespace activesurface
{

class MovingTarget;
class TargetFrames;
class Warnings;
struct InputData;
struct LabelFacts;
struct OwnedPart;
struct ParticleArrays;
struct ParticleFrame;
struct TargetOptions;

class InputShape
{
public:
  InputShape() = default;
  InputShape(const InputShape&) = delete;
  void operator=(const InputShape&) = delete;
  virtual ~InputShape();

  /** Name of the kind in messages: "particles", "a mesh". */
  virtual const char* GetName() const = 0;
  bool IsOfKindOf(const InputShape& other) const;

  /**
   * Returns false for an input without points. Such an input has no kind, and is compatible with
   * shapes of all kinds.
   */
  virtual bool HasPoints() const { return true; }

  /** Returns true if there is no usable point, so that no surface can start on this shape. */
  virtual bool IsEmpty() const { return false; }

  /**
   * Makes all positions relative to an origin, initially 0. If the origin changes, call Prepare
   * again.
   */
  void MoveTo(const std::array<double, 3>& origin);

  /** Returns false for points without any cell, not even a vertex. */
  virtual bool HasCells() const { return true; }

  /** Returns true if the other shape may be an empty shape of this kind. */
  virtual bool IsEmptyAs(const InputShape& other) const;

  /** Returns true if a surface can start on this shape as the input of port 1. */
  virtual bool CanStart() const { return false; }

  /**
   * Makes radii and functions, and reports ignored data. Call this when the shape is added, and
   * again when the voxel size is available. Returns a message about defects of usable data, or an
   * empty string. Throws for unusable data.
   */
  virtual std::string Prepare(const TargetOptions& options, const Warnings& messages);

  /**
   * Returns a message about parts that are too thin for the voxels, or an empty string. Call this
   * after Prepare, when the domain is available.
   */
  virtual std::string DescribeThinParts(const TargetOptions& options) const;

  /**
   * Adds the box of this shape to `images` if this shape is an image, otherwise to `shapes`; see
   * MakeDomain (SurfaceDomain.h) for the use of both.
   */
  virtual void AddBounds(
    const TargetOptions& options, vtkBoundingBox& shapes, vtkBoundingBox& images) const;

  /**
   * Smallest spacing of an image along the axes with several samples [length]; 0 for other kinds.
   */
  virtual double GetPixel() const { return 0.0; }

  /**
   * Returns the target along frames of this kind and empty frames. The caller owns the frames,
   * which must contain the steps that the target's MoveAlong uses.
   */
  virtual std::unique_ptr<MovingTarget> MakeTarget(
    const TargetFrames& frames, const TargetOptions& options) const = 0;

  /** Null for a kind without an implicit function, and before Prepare has made it. */
  virtual vtkImplicitFunction* GetFunction() const { return nullptr; }

  /** Null unless the shape is an image that is smoothed as a label; valid after Prepare. */
  virtual const LabelFacts* GetLabel() const { return nullptr; }
  /** Null unless the kind is particles. */
  virtual const ParticleFrame* GetParticles() const { return nullptr; }

  /** The points of particles or of a skeleton; null for other kinds. */
  virtual const ParticleFrame* GetPoints() const { return this->GetParticles(); }

  /** Returns true if this shape was read with these arrays, or uses none. */
  virtual bool HasArrays(const ParticleArrays& arrays) const;

  /** Checksum of the input's data (ContentSum.h). */
  std::uint64_t Content = 0;

  /**
   * Set if this shape has only the particles that this rank owns (OwnedParticles.h) or receives
   * (SharedFrames.h); otherwise null.
   */
  std::shared_ptr<const OwnedPart> Owned;

protected:
  /** Copies the checksum and the origin. */
  void CopyFacts(const InputShape& other)
  {
    this->Content = other.Content;
    this->Origin = other.Origin;
  }

  /** Adds the offset to all positions. */
  virtual void MoveBy(const double offset[3]);

private:
  std::array<double, 3> Origin = {};
};

/**
 * Returns a shape of the kind of the data. Throws std::invalid_argument for data that cannot be a
 * target, and for missing or unsuitable arrays.
 */
std::unique_ptr<InputShape> MakeInputShape(const InputData& input);

}

#endif
