// Input port of a surface: time steps, shapes, and changes upstream.

#ifndef SurfaceInput_h
#define SurfaceInput_h

#include "Ranks/Agreement.h"
#include "Ranks/PieceGather.h"
#include "Targets/InputData.h"
#include "Targets/InputShape.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkAlgorithm;
class vtkDataObject;
class vtkDataSet;
class vtkInformation;

namespace activesurface
{

class SurfaceInput
{
public:
  enum Ports
  {
    Target = 0,
    Initial = 1
  };

  // The caller owns `ranks`. Only Read is collective.
  SurfaceInput(vtkAlgorithm* filter, Ports port, Agreement& ranks);

  // Accepted data types of a port. Each port is optional.
  static void DescribePort(int port, vtkInformation* information);
  static bool Accepts(int port, vtkDataObject* data);

  bool IsConnected() const;

  // Returns a number that changes if an algorithm or data upstream is modified, but not if another
  // time is requested. Returns 0 without an input.
  std::uint64_t GetPipelineMTime() const;

  // Returns true if the input is connected and its pipeline MTime is still `time`.
  bool IsStillAt(std::uint64_t time) const
  {
    return this->IsConnected() && this->GetPipelineMTime() == time;
  }

  // Time steps of the input; empty without an input.
  static std::vector<double> GetTimeSteps(vtkInformation* information);
  // Returns true if the input has a nonempty time range and no time steps.
  static bool IsContinuous(vtkInformation* information);

  // Returns descriptions of the arrays chosen for radii, ids, strengths, values of the target's
  // image and values of the initial image. A description is empty if no array is chosen.
  std::array<std::string, 5> DescribeArrays() const;

  // Returns true if the pipeline sends the blocks of the data one by one, each block as the input.
  // Valid only before a request for data.
  bool IsSplit(vtkInformation* information) const;

  // Describes the particle arrays to keep. all: all arrays. velocities: the array of velocities, if
  // one is chosen.
  ParticleArrays DescribeParticleArrays(bool all, bool velocities) const;

  // Reads the pieces of all ranks. areShared: each rank keeps only a part of the particles. Throws
  // std::invalid_argument for data that cannot be a target, and for missing or unsuitable arrays.
  // Collective.
  std::shared_ptr<InputShape> Read(vtkInformation* information,
    const ParticleArrays& kept = ParticleArrays(), bool areShared = false) const;

  // Throws like Read, but only for the data of this rank. Ignores data that Accepts rejects.
  void Check(vtkDataObject* data) const;

  // Requests all data (on several ranks: this rank's piece) at the first time step or, without
  // steps, at the start of the time range.
  void RequestFirst(vtkInformation* information) const;

  // Update the input to a time, or to its first time. Return false on failure.
  bool Update(vtkInformation* information, double time) const;
  bool UpdateFirst(vtkInformation* information) const;

private:
  class ArraysOf;

  static std::vector<const char*> ListTypes(int port);
  bool IsArrayChosen(int index) const;
  std::string DescribeArray(int index) const;
  vtkAbstractArray* FindArray(int index, vtkDataSet* data) const;
  vtkAbstractArray* FindValues(vtkDataSet* image) const;
  struct OwnPiece
  {
    InputPiece Piece;
    std::unique_ptr<InputShape> Shape; // of the piece; null if the rank has no data
    PieceFacts Facts;
  };
  OwnPiece MakeOwn(vtkDataSet* data, const ParticleArrays& kept) const;
  InputPiece MakePiece(vtkDataSet* data, const ParticleArrays& kept) const;
  std::shared_ptr<InputShape> ReadOwned(const OwnPiece& own, const AllPieces& all,
    const ParticleArrays& kept, const std::string& name) const;
  std::unique_ptr<InputShape> ReadWhole(
    const InputPiece& piece, const ParticleArrays& kept, const std::string& name) const;
  void Request(vtkInformation* information) const;
  bool UpdateProducer() const;

  vtkAlgorithm* Filter;
  Ports Port;
  Agreement& Ranks;
};

}

#endif
