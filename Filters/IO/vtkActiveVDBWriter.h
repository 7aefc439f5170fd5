/**
 * @class   vtkActiveVDBWriter
 * @brief   writes an active surface, a closed mesh or an image as .vdb files
 *
 * @par Input
 * - Output port 0 or 1 of a vtkActiveImplicitSurface. The grids are made from the surface's narrow
 *   band, without a dense image.
 * - Any closed vtkPolyData: each edge belongs to an even number of polygons, whose points exist and
 *   are finite. OpenVDB's meshToVolume converts the mesh with voxels of VoxelSize.
 * - Any vtkImageData.
 *
 * @par Grids of a surface
 * - "surface": a level set. The values are the distance to the triangles [length], exact for a
 *   skin, negative inside, within 3 voxels on either side, and +-3 voxels beyond. The transform is
 *   exact: nodes are at multiples of the vtkActiveImplicitSurface's VoxelSize or, for another mesh,
 *   the writer's.
 * - The properties below add the state to resume from, a fog, the velocity and the point arrays.
 *
 * @par Grids of an image
 * - A grid for the active scalars, else for the first point array. The grid has the array's name,
 *   or "density" for an array without a name. Active values are those that are not 0 or, in a level
 *   set, those within 3 voxels of the surface; see GridClass.
 *
 * @par Metadata of the file and of all grids
 * - creator, time [pipeline time] (0 if the input has none), frame (index of the time step, from
 *   0), units, and, from a vtkActiveImplicitSurface, motion_X for each numeric property X that
 *   determines the motion, except VoxelSize.
 *
 * @par Errors
 * - A file is written under a temporary name, validated and then renamed, so it appears as a whole
 *   or not at all. A failure is an error with an ErrorCode.
 */

#ifndef vtkActiveVDBWriter_h
#define vtkActiveVDBWriter_h

#include "vtkActiveIOModule.h" // for the export macro
#include "vtkAlgorithm.h"
#include "vtkSmartPointer.h" // for the controller

#include <string> // for names

class vtkDataObject;
class vtkMultiProcessController;

class VTKACTIVEIO_EXPORT vtkActiveVDBWriter : public vtkAlgorithm
{
public:
  static vtkActiveVDBWriter* New();
  vtkTypeMacro(vtkActiveVDBWriter, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Name of the file or series. The number of the time step replaces the last run of #, with at
   * least as many digits, else %d or %04d. Without these, WriteAllTimeSteps puts a number of four
   * or more digits before the extension, name.0007.vdb. Default: none, which is an error.
   */
  void SetFileName(const char* name);
  const char* GetFileName() const { return this->FileName.c_str(); }
  ///@}

  ///@{
  /**
   * Data to write, instead of an input connection. Default: none.
   */
  void SetInputData(vtkDataObject* data) { this->SetInputDataObject(0, data); }
  ///@}

  ///@{
  /**
   * Makes Write() write a file for each time step of the input. Off: one file, for the time of the
   * input's last update. Default: off.
   */
  vtkSetMacro(WriteAllTimeSteps, vtkTypeBool);
  vtkGetMacro(WriteAllTimeSteps, vtkTypeBool);
  vtkBooleanMacro(WriteAllTimeSteps, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Adds the grid "potential", the state without loss, from which the filter's LoadState resumes
   * bitwise identically. The input has to be a vtkActiveImplicitSurface with EvolutionMode
   * TRANSIENT, at one of its time steps; there is no state between two time steps, or in a steady
   * state. The state is never written as half floats. Default: off.
   */
  vtkSetMacro(WriteState, vtkTypeBool);
  vtkGetMacro(WriteState, vtkTypeBool);
  vtkBooleanMacro(WriteState, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Adds the grid "density", a fog: 1 inside, falling to 0 at the surface over the last 3 voxels.
   * An error with an image other than a vtkActiveImplicitSurface's output. Default: off.
   */
  vtkSetMacro(WriteDensity, vtkTypeBool);
  vtkGetMacro(WriteDensity, vtkTypeBool);
  vtkBooleanMacro(WriteDensity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Adds the grid "v", the velocity [length/time] near the surface, for motion blur. The grid is
   * made from the skin's point array "Velocity" (see ComputeVelocity), which has to exist. Default:
   * off.
   */
  vtkSetMacro(WriteVelocity, vtkTypeBool);
  vtkGetMacro(WriteVelocity, vtkTypeBool);
  vtkBooleanMacro(WriteVelocity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Adds a grid, named after the array, for each point array of one or three components. Grids of a
   * surface have values near the skin: floating-point numbers are interpolated at the skin's
   * nearest point; integers are those of the corner with the largest weight in this interpolation.
   * Vectors of integers beyond int32 become double and are interpolated. Grids of an image have the
   * values of all points. Arrays of another number of components are an error. Default: off.
   */
  vtkSetMacro(WritePointArrays, vtkTypeBool);
  vtkGetMacro(WritePointArrays, vtkTypeBool);
  vtkBooleanMacro(WritePointArrays, vtkTypeBool);
  ///@}

  enum GridClasses
  {
    UNKNOWN = 0,
    LEVEL_SET = 1,
    FOG_VOLUME = 2
  };

  ///@{
  /**
   * Meaning of an image's scalars. UNKNOWN (0): anything. LEVEL_SET (1): a distance [length] that
   * becomes a narrow band of 3 voxels in single precision. FOG_VOLUME (2): a density. Default:
   * UNKNOWN.
   */
  vtkSetClampMacro(GridClass, int, UNKNOWN, FOG_VOLUME);
  vtkGetMacro(GridClass, int);
  void SetGridClassToUnknown() { this->SetGridClass(UNKNOWN); }
  void SetGridClassToLevelSet() { this->SetGridClass(LEVEL_SET); }
  void SetGridClassToFogVolume() { this->SetGridClass(FOG_VOLUME); }
  ///@}

  ///@{
  /**
   * Size of the voxels [length] for a mesh that does not come from a vtkActiveImplicitSurface.
   * Range: > 0, or -1, automatic: the longest side of the mesh's bounds / 64. Default: -1.
   */
  vtkSetClampMacro(VoxelSize, double, -1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(VoxelSize, double);
  ///@}

  ///@{
  /**
   * Writes floating-point numbers, except those of the state, as half floats of three digits.
   * Default: off.
   */
  vtkSetMacro(HalfFloat, vtkTypeBool);
  vtkGetMacro(HalfFloat, vtkTypeBool);
  vtkBooleanMacro(HalfFloat, vtkTypeBool);
  ///@}

  enum Compressions
  {
    NONE = 0,
    ACTIVE_MASK = 1,
    ZIP = 2,
    BLOSC = 3
  };

  ///@{
  /**
   * Lossless compression of values. NONE (0). ACTIVE_MASK (1): only active values are stored where
   * that is lossless. ZIP (2), slow, and BLOSC (3), fast: active values are packed by zlib or
   * Blosc. With ZIP, OpenVDB leaves level sets and fogs unpacked. Default: BLOSC.
   */
  vtkSetClampMacro(Compression, int, NONE, BLOSC);
  vtkGetMacro(Compression, int);
  void SetCompressionToNone() { this->SetCompression(NONE); }
  void SetCompressionToActiveMask() { this->SetCompression(ACTIVE_MASK); }
  void SetCompressionToZip() { this->SetCompression(ZIP); }
  void SetCompressionToBlosc() { this->SetCompression(BLOSC); }
  ///@}

  ///@{
  /**
   * Unit of length, as free text, for the metadata "units". Default: none.
   */
  void SetUnits(const char* units);
  const char* GetUnits() const { return this->Units.c_str(); }
  ///@}

  ///@{
  /**
   * Ranks of a parallel program, which have to call Write together. All ranks update the input, and
   * rank 0 writes its own data. A vtkActiveImplicitSurface on these ranks sends all data to rank 0.
   * With null, or a controller of a single process, this process writes. Default: VTK's global
   * controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  /**
   * Updates the input and writes the files. Returns 0, with an error and ErrorCode, after a failure
   * or if AbortExecute was set before a time step (with WriteAllTimeSteps). Files of earlier time
   * steps are kept.
   */
  int Write();

protected:
  vtkActiveVDBWriter();
  ~vtkActiveVDBWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkActiveVDBWriter(const vtkActiveVDBWriter&) = delete;
  void operator=(const vtkActiveVDBWriter&) = delete;

  void WriteSteps();
  void WriteData(const std::string& file, vtkDataObject* data, int frame);

  std::string FileName;
  std::string Units;
  vtkTypeBool WriteAllTimeSteps = 0;
  vtkTypeBool WriteState = 0;
  vtkTypeBool WriteDensity = 0;
  vtkTypeBool WriteVelocity = 0;
  vtkTypeBool WritePointArrays = 0;
  int GridClass = UNKNOWN;
  double VoxelSize = -1.0;
  vtkTypeBool HalfFloat = 0;
  int Compression = BLOSC;
  vtkSmartPointer<vtkMultiProcessController> Controller;
};

#endif
