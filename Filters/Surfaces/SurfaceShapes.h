// The shapes that a surface is attracted by and starts on: from the functions of the settings, or
// from the frames of the inputs, as these come in.

#ifndef SurfaceShapes_h
#define SurfaceShapes_h

#include "MovingTarget.h"
#include "SurfaceSettings.h"
#include "TargetFrames.h"
#include "Warnings.h"

#include <memory>

namespace activesurface
{

class SurfaceShapes
{
public:
  // The settings are the caller's; after a change of them comes Clear.
  SurfaceShapes(const SurfaceSettings& settings, Warnings& warnings);
  SurfaceShapes(const SurfaceShapes&) = delete;
  void operator=(const SurfaceShapes&) = delete;

  void Clear();

  // A frame of the target; the two that were added last are held. Throws std::invalid_argument for
  // one that does not fit those before or cannot be used; it then is not held.
  void Add(int step, TargetFrame frame);
  bool Has(int step) const { return this->Frames.Has(step); }

  // Whether a frame of particles was read with those extras, see TargetFrame.
  bool HasExtras(int step, const std::string& extras) const;

  // The frames that are held, and of what kind they are: Nothing, as long as none is.
  TargetFrames& GetFrames() { return this->Frames; }
  TargetKind GetKind() const { return this->Kind; }

  // The frame that is the initial shape, if the settings have one. Throws as Add.
  void SetInitial(TargetFrame frame);
  bool WantsInitial() const;

  // Null as long as the bounds are not known: before the first frames came in, or for functions
  // that have none. Throws for settings that cannot be.
  const SurfaceDomain* FindDomain();

  // Whether the surface would start on an empty frame.
  bool StartsOnNothing() const;

  // Puts the target to the first frame, anew. Comes when the domain is known, before GetTarget.
  void StartTarget();

  // What attracts. It may be another one after Add, and goes with Clear.
  PotentialTarget& GetTarget();
  // The same, where it goes from step to step; else null.
  MovingTarget* GetMovingTarget();

  // What the surface starts on; null: on the target.
  std::unique_ptr<PotentialTarget> MakeStart();

private:
  void CheckKind(int step, TargetFrame& frame);
  void GiveRadii(ParticleFrame& frame);
  double GetRadius() const;
  void MakeFunction(int step, TargetFrame& frame);
  void WarnOfThinParts(const TargetFrame& frame, const std::string& where);
  void MakeInitialFunction();
  bool AddFirstBounds(vtkBoundingBox& shapes, vtkBoundingBox& images) const;
  void MakeTarget();

  const SurfaceSettings& Settings;
  Warnings& Messages;

  TargetFrames Frames;
  TargetKind Kind = TargetKind::Nothing; // of the frames, as soon as one was not empty
  double EstimatedRadius = 0.0;
  bool ThinPartsKnown = false; // of the first grid
  bool HasInitial = false;
  TargetFrame Initial;
  bool DomainKnown = false;
  SurfaceDomain Domain;

  std::unique_ptr<PotentialTarget> Target;
  MovingTarget* Moving = nullptr;                // the same, if it is one
  TargetKind KindOfTarget = TargetKind::Nothing; // for which it was made
};

}

#endif
