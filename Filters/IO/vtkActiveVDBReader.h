/**
 * @class   vtkActiveVDBReader
 * @brief   reads .vdb files of any origin: volumes as images, points as poly data, series as time
 *
 * Output: of level sets, fogs and other grids of numbers (float, half, double, int32, int64, bool,
 * mask, vectors of three) a vtkImageData whose points are the grid's voxels, with one point array
 * for each of the chosen grids, which have to be of one transform; of points grids a vtkPolyData
 * with a vertex for each point and all attributes (groups as 0 or 1). Values of voxels that are not
 * stored, tiles and background, are there too. Scale and translation become spacing and origin,
 * rotations the direction matrix; sheared grids and those in perspective are refused.
 *
 * A level set goes to the Target or the Initial of a vtkActiveImplicitSurface, or to a
 * vtkGridPotential, as it is, without a dense image, with OutputDense off: the output then has an
 * extent, but no array, and carries the grid.
 *
 * Before anything is read, a file is validated down to its last leaf, so that a damaged one is
 * an error with a sentence, and ErrorCode, and empty outputs. Then only the chosen grids are read,
 * and of them, if Region is a box and the file allows it, only the leaves that meet the box. Files
 * of before OpenVDB 2 are refused.
 *
 * Several files are a series: time steps, with the metadata "time" where all have one and they
 * increase, else numbers 0, 1, 2... A time between two of them is the earlier one.
 *
 * Of the pieces that the ranks of a parallel program ask for, the first one is all of the data.
 */

#ifndef vtkActiveVDBReader_h
#define vtkActiveVDBReader_h

#include "vtkActiveIOModule.h" // for the export macro
#include "vtkDataObjectAlgorithm.h"

#include <memory> // for Internals
#include <string> // for names
#include <vector> // of them

class vtkImageData;
class vtkPolyData;
class vtkStringArray;

class VTKACTIVEIO_EXPORT vtkActiveVDBReader : public vtkDataObjectAlgorithm
{
public:
  static vtkActiveVDBReader* New();
  vtkTypeMacro(vtkActiveVDBReader, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file, or with AddFileName those of a series, in their order; SetFileName begins anew.
   * Default: none, which is an error.
   */
  void SetFileName(const char* name);
  void AddFileName(const char* name);
  void ClearFileNames();
  int GetNumberOfFileNames() const { return static_cast<int>(this->FileNames.size()); }
  const char* GetFileName(int i = 0) const;
  ///@}

  ///@{
  /**
   * The grid to read, by its name, or with AddGridName several. Of several grids of one name the
   * others are name[1], name[2]... Default: none, the first level set, else the first fog, else the
   * first points, else the first of any other kind.
   */
  void SetGridName(const char* name);
  void AddGridName(const char* name);
  void ClearGridNames();
  ///@}

  enum Regions
  {
    ACTIVE = 0,
    INDEX = 1,
    WORLD = 2
  };

  ///@{
  /**
   * What of a volume becomes the image: the box of all active voxels (ACTIVE (0)), IndexRegion
   * (INDEX (1)) or the voxels that cover WorldRegion (WORLD (2)). Default: ACTIVE.
   */
  vtkSetClampMacro(Region, int, ACTIVE, WORLD);
  vtkGetMacro(Region, int);
  void SetRegionToActive() { this->SetRegion(ACTIVE); }
  void SetRegionToIndex() { this->SetRegion(INDEX); }
  void SetRegionToWorld() { this->SetRegion(WORLD); }
  ///@}

  ///@{
  /**
   * Box in index coordinates of the grid: x min, x max, y min... inclusive. Default: 0 -1 0 -1 0
   * -1, empty.
   */
  vtkSetVector6Macro(IndexRegion, int);
  vtkGetVector6Macro(IndexRegion, int);
  ///@}

  ///@{
  /**
   * Box in space [length]: x min, x max, y min... Default: 1 -1 1 -1 1 -1, empty.
   */
  vtkSetVector6Macro(WorldRegion, double);
  vtkGetVector6Macro(WorldRegion, double);
  ///@}

  ///@{
  /**
   * Takes a voxel of so many along each axis, those whose index coordinates are multiples of it,
   * as they are: nothing is averaged. Range: 1 to 4096. Default: 1, all voxels.
   */
  vtkSetClampMacro(DownsamplingFactor, int, 1, 4096);
  vtkGetMacro(DownsamplingFactor, int);
  ///@}

  ///@{
  /**
   * Whether volumes become dense images. If not, the image has no arrays, and carries a level set
   * for those who can use the grid itself, see above. Default: on.
   */
  vtkSetMacro(OutputDense, vtkTypeBool);
  vtkGetMacro(OutputDense, vtkTypeBool);
  vtkBooleanMacro(OutputDense, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Guard of the memory: a dense image, or points, of more than that are an error instead.
   * Range: >= 1. Default: 200000000.
   */
  vtkSetClampMacro(MaximumNumberOfPoints, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(MaximumNumberOfPoints, vtkIdType);
  ///@}

  ///@{
  /**
   * The grids of the file, of a series the one that was looked at last; known after
   * UpdateInformation(). The type is that of the value (float, double, int32, int64, bool, mask,
   * vec3s, vec3d, vec3i, points; half floats say "float" and HalfFloat), or of an unknown tree; the
   * class "level set", "fog volume", "staggered vector field" or "unknown". Bounds are those of the
   * active voxels in index coordinates. Nothing, 0 or empty for a number that does not exist.
   */
  int GetNumberOfGrids();
  vtkStringArray* GetGridNames();
  const char* GetGridName(int i);
  const char* GetGridType(int i);
  const char* GetGridClass(int i);
  bool GetGridIsHalfFloat(int i);
  bool GetGridIsInstance(int i);
  vtkIdType GetGridActiveVoxels(int i);
  void GetGridBox(int i, int box[6]);
  void GetGridVoxelSize(int i, double size[3]);
  ///@}

  ///@{
  /**
   * Metadata as text: the value of a name, empty if it is not there; or all, "name: value" a line.
   * Those of the file, and with a number those of a grid.
   */
  std::string GetMetadata(const std::string& name);
  std::string GetAllMetadata();
  std::string GetGridMetadata(int i, const std::string& name);
  std::string GetAllGridMetadata(int i);
  ///@}

  ///@{
  /** The output, if it is of that kind, else null. */
  vtkImageData* GetImageOutput();
  vtkPolyData* GetPolyDataOutput();
  ///@}

protected:
  vtkActiveVDBReader();
  ~vtkActiveVDBReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkActiveVDBReader(const vtkActiveVDBReader&) = delete;
  void operator=(const vtkActiveVDBReader&) = delete;

  struct Internals;

  int Fail(vtkInformationVector* output, const char* sentence);
  void OpenFile(vtkInformation* output);
  void PublishExtent(vtkInformation* output) const;
  void FillOutput(vtkDataObject* data);
  void MakeImage(vtkImageData* image);
  void MakePoints(vtkPolyData* points);

  std::vector<std::string> FileNames;
  std::vector<std::string> GridNames;
  int Region = ACTIVE;
  int IndexRegion[6] = { 0, -1, 0, -1, 0, -1 };
  double WorldRegion[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  int DownsamplingFactor = 1;
  vtkTypeBool OutputDense = 1;
  vtkIdType MaximumNumberOfPoints = 200000000;

  std::unique_ptr<Internals> Internal;
};

#endif
