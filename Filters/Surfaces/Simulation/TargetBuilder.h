// The shapes that a surface is attracted by and starts on: from the functions of the settings, or
// from the frames of the inputs, as these come in.

#ifndef TargetBuilder_h
#define TargetBuilder_h

#include "Simulation/SurfaceDomain.h"
#include "Simulation/SurfaceSettings.h"
#include "Simulation/Warnings.h"
#include "Targets/MovingTarget.h"
#include "Targets/ParticleFrame.h"
#include "Targets/ShapePreparation.h"
#include "Targets/TargetFrames.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace activesurface
{

class TargetBuilder
{
public:
  // The settings are the caller's; after a change of them comes Clear.
  TargetBuilder(const SurfaceSettings& settings, Warnings& warnings);
  TargetBuilder(const TargetBuilder&) = delete;
  void operator=(const TargetBuilder&) = delete;

  void Clear();

  // Guard of the distances to the meshes that come: ten times as many voxels.
  void SetMaximumNumberOfActiveVoxels(std::size_t maximum) { this->MaximumActiveVoxels = maximum; }

  // The target at a step; the two that were added last are held. Throws std::invalid_argument for
  // one that does not fit those before or cannot be used; it then is not held.
  void Add(int step, std::shared_ptr<InputShape> shape);
  bool Has(int step) const { return this->Frames.Has(step); }

  // Replaces a step by this rank's part of it; and a step and the next one by their parts.
  void SetPart(int step, const std::shared_ptr<InputShape>& shape);
  void SetPair(int step, const std::shared_ptr<InputShape>& earlier,
    const std::shared_ptr<InputShape>& later, bool areShuffled);
  // Distance along each axis from a rank's leaves within which it needs particles
  // [voxels].
  int FindMarginOfRanks();

  const TargetFrames& GetFrames() const { return this->Frames; }

  // True if the held frame of a step was made of the same data as another.
  bool IsUnchanged(int step, const InputShape& shape) const
  {
    return this->Frames.Find(step)->Content == shape.Content;
  }

  // Whether one of the frames from a step to another, as far as they are held, has particles; of a
  // target that stands still its only frame. Later frames do not count: they may not be known yet.
  bool HasParticles(int first, int last) const
  {
    return this->FindKind(first, last)->GetParticles() != nullptr;
  }
  // Whether particles may come, as nothing else has.
  bool MayHaveParticles() const
  {
    return this->Settings.UsesInput() && (!this->Kind->HasPoints() || this->Kind->GetParticles());
  }
  // And whether their velocity carries the surface.
  bool MayCarry() const { return this->MayHaveParticles() && this->GetOptions().Carries; }

  // Usual distance of the particles; 0: not known.
  double FindSpacing() const;

  // The periodic box, from the origin of the shapes.
  PeriodicBox GetBox() const;
  // Its margin around the particles of a step that is held; by the spacing if none is.
  double FindMargin(int step) const;

  // The particles' spacing [length]; 0 where none was estimated. One that is kept is that of a
  // state whose first steps, not read again, have particles.
  double GetEstimatedSpacing() const { return this->EstimatedSpacing; }
  void KeepEstimatedSpacing(double spacing)
  {
    this->EstimatedSpacing = this->EstimatedSpacing > 0.0 ? this->EstimatedSpacing : spacing;
  }

  // Particles and spacing of a frame.
  struct SpacingSample
  {
    std::size_t Particles = 0;
    double Spacing = 0.0; // 0: unknown
    bool HasRadii = false;
  };
  // Returns true if the spacing has to be found from several frames before the first is added.
  bool WantsSpacing() const;
  // Steps besides the first that are sampled for it.
  std::vector<int> ListSpacingSteps() const;
  static SpacingSample SampleSpacing(const InputShape& shape, const PeriodicBox& box);
  // Sets the spacing to the least one of the frames that have enough particles; to that of the
  // first sample, which is the first frame's, if that is the same to 1 %.
  void SettleSpacing(const std::vector<SpacingSample>& samples);

  // A box that holds the inside of the target at a step that is held, if it is no particles; within
  // the domain's for a function, or one that is inverted. Not valid where there is no target.
  vtkBoundingBox FindBoundsOfInside(int step) const;

  // The initial shape, if the settings have one as input. Throws as Add.
  void SetInitial(std::shared_ptr<InputShape> shape);
  bool WantsInitial() const { return this->Settings.Inputs.HasInitialInput && !this->Initial; }

  // Null as long as the bounds are not known: before the first frames came in, or for functions
  // that have none. Throws for settings that cannot be.
  const SurfaceDomain* FindDomain();
  // Null too where it was not asked for.
  const SurfaceDomain* GetDomain() const { return this->DomainKnown ? &this->Domain : nullptr; }
  // Origin of the positions of all shapes, see SurfaceDomain.
  const std::array<double, 3>& GetOrigin() const { return this->Domain.Origin; }

  // Whether the surface would start on an empty frame.
  bool StartsOnNothing() const;

  // Makes another target, at the first frame. Comes after FindDomain, before GetTarget.
  void StartTarget();
  // Makes it ready to be evaluated at points.
  void CompleteTarget();

  // What attracts. It may be another one after UseFramesFrom, and goes with Clear and ForgetTarget.
  PotentialTarget& GetTarget();
  // The target is of the kind of a step and the next one.
  void UseFramesFrom(int step);
  // Another number is another one.
  std::size_t GetTargetNumber() const { return this->TargetNumber; }
  // The next one is made with the settings as they are then.
  void ForgetTarget()
  {
    this->Moving = nullptr;
    this->Target.reset();
  }
  // The same, where it goes from step to step; else null.
  MovingTarget* GetMovingTarget();

  // Another one that attracts alike, on its way from a step that is held to the next between two
  // motion times. It uses the frames that are held, until the next Add or Clear. hasPoints: whether
  // it can be evaluated at points, at the beginning of the way.
  std::unique_ptr<PotentialTarget> MakeTargetAt(
    int step, double begin, double end, bool hasPoints = true) const;

  // What the surface starts on; null: on the target. Comes after StartTarget.
  std::unique_ptr<PotentialTarget> MakeStart();

private:
  using KindPointer = std::shared_ptr<const InputShape>;

  void CheckKind(int step, const InputShape& shape) const;
  KindPointer FindKind(int first, int last) const;
  std::string DescribeStep(int step) const;
  ShapeOptions GetOptions() const;
  ShapePreparation GetPreparation();
  void Prepare(int step, InputShape& shape);
  void Tell(const std::string& reason, const std::string& sentence); // unless it is empty
  void WarnOfThinParts(const InputShape& shape, const std::string& where);
  void PrepareInitial();
  double GetSpacing() const;
  double GetPixel() const; // of the first images [length]; 0: there are none
  double GetNoiseAtNodes() const;
  // The shapes that are held, to positions relative to the domain's origin.
  void MoveToOrigin();
  bool AddFirstBounds(vtkBoundingBox& shapes, vtkBoundingBox& images) const;
  std::unique_ptr<PotentialTarget> MakeFunctionTarget() const;
  void MakeTarget();

  const SurfaceSettings& Settings;
  Warnings& Messages;
  std::size_t MaximumActiveVoxels = 50000000;

  TargetFrames Frames;
  KindPointer Kind; // the last shape that has one
  double EstimatedSpacing = 0.0;
  bool ThinPartsKnown = false; // and told
  std::shared_ptr<InputShape> Initial;
  bool DomainKnown = false;
  SurfaceDomain Domain;

  std::unique_ptr<PotentialTarget> Target; // null: to be made
  KindPointer KindOfTarget;
  MovingTarget* Moving = nullptr; // the same, if it is one
  std::size_t TargetNumber = 0;   // how many were made
};

}

#endif
