/**
 * What the input is at one of its time steps, as one kind of target. Each kind is a class of its
 * own, in a file of its own; InputKinds.cxx lists them.
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
struct HomePart;
struct ParticleArrays;
struct ParticleFrame;
struct ShapeOptions;
struct ShapePreparation;

class InputShape
{
public:
  InputShape() = default;
  InputShape(const InputShape&) = delete;
  void operator=(const InputShape&) = delete;
  virtual ~InputShape();

  /** As messages call the kind: "particles", "a mesh". */
  virtual const char* GetName() const = 0;
  bool IsOfKindOf(const InputShape& other) const;

  /** Without points it has no kind: it fits between the shapes of all kinds. */
  virtual bool HasPoints() const { return true; }

  /** Without points that can be used: no surface can start there. */
  virtual bool IsEmpty() const { return false; }

  /** Makes all positions relative to an origin, from those of the last call or of the input. If
   * they change, Prepare has to come again. */
  void MoveTo(const std::array<double, 3>& origin);

  /** Else points alone. */
  virtual bool HasCells() const { return true; }

  /** Whether another shape is what an empty one of this kind looks like. */
  virtual bool IsEmptyAs(const InputShape& other) const;

  /** Whether a surface can start on it as the input of port 1. */
  virtual bool CanStart() const { return false; }

  /**
   * Radii and functions are made; what is left out is reported. Comes before all that follows, and
   * may come again when the domain is known. Returns what is wrong with the data though they can be
   * used, a sentence; or nothing. Throws std::invalid_argument and std::runtime_error.
   */
  virtual std::string Prepare(ShapePreparation& preparation);

  /** What a user should know of parts that are too thin for the voxels, a sentence; or nothing.
   * Comes after Prepare, when the domain is known. */
  virtual std::string DescribeThinParts(const ShapeOptions& options) const;

  /** The box of a shape, which the domain is to be larger than, or of an image, which it is. */
  virtual void AddBounds(
    const ShapeOptions& options, vtkBoundingBox& shapes, vtkBoundingBox& images) const;

  /** Smallest distance of an image's samples along an axis [length]; 0 for other kinds. */
  virtual double GetPixel() const { return 0.0; }

  /**
   * What attracts, along frames of this kind and empty ones. The frames are the caller's, and have
   * to hold what the target's MoveAlong asks for.
   */
  virtual std::unique_ptr<MovingTarget> MakeTarget(
    const TargetFrames& frames, const ShapeOptions& options) const = 0;

  /** Null for a kind that is no implicit function. */
  virtual vtkImplicitFunction* GetFunction() const { return nullptr; }

  /** Null unless the kind is particles. */
  virtual const ParticleFrame* GetParticles() const { return nullptr; }

  /** The points that it is made of, particles or those of a skeleton; null for other kinds. */
  virtual const ParticleFrame* GetPoints() const { return this->GetParticles(); }

  /** Whether it was read with these, or has no use for them. */
  virtual bool HasArrays(const ParticleArrays& arrays) const;

  /** Checksum of the data that it was made of (ContentSum.h). */
  std::uint64_t Content = 0;

  /** The part of the input whose home is this rank, if ranks have parts of it; else null. */
  std::shared_ptr<const HomePart> Home;

protected:
  /** The checksum and the origin. */
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

}

#endif
