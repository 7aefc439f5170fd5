/**
 * @class   vtkActiveEXRReader
 * @brief   reads .exr images: all layers, as arrays
 *
 * One part of a file becomes an image of one slice, whose point arrays are the file's layers:
 *
 *   channels                            array
 *   R, G, B, A or R, G, B               RGBA or RGB, which are made the scalars
 *   N.X, N.Y, N.Z (or x, y, z)          N, of three components
 *   forward.u, forward.v                forward, of two
 *   diffuse.R, diffuse.G, diffuse.B     diffuse, of three; of four where there is diffuse.A
 *   weights.0, weights.1, ...           weights
 *   any other, as Z or id or light.key  an array of its own name
 *
 * HALF and FLOAT are read as float, bit by bit (NaN and infinity too), UINT as unsigned int. Colors
 * are what the file holds: linear. Channels with fewer samples than pixels are repeated over the
 * pixels that a sample stands for. Scanline and tiled files, of tiled ones the finest level; deep
 * data is refused with a sentence.
 *
 * Rows are VTK's, from below: point (0, 0) is the lower left pixel of the display window, whatever
 * the file's own coordinates, and the extent is the data window; it may begin elsewhere, or stick
 * out (see Window). The attributes of the header come as field data of the output, by their names.
 *
 * Several files (SetFileNames, of vtkImageReader2) are the time steps of a series: at the times
 * that all their headers tell, as vtkActiveEXRWriter writes them, if they rise from file to file,
 * else at 0, 1, 2 and so on. Their extent is the one that covers all of them, with 0 where a file
 * has no pixel. A time between two steps is the earlier one. Of vtkImageReader2's other properties
 * DataSpacing, DataOrigin and MemoryBuffer have their meaning; the rest none.
 *
 * Whatever is wrong with a file (missing, truncated, damaged, larger than MaximumMemory, no EXR) is
 * one error with a sentence, ErrorCode tells the kind (vtkErrorCode), and the output is empty.
 * Sizes that a header claims are checked against the file's before anything is allocated.
 *
 * vtkImageReader2Factory knows the reader after RegisterWithFactory(); Python's package calls it.
 */

#ifndef vtkActiveEXRReader_h
#define vtkActiveEXRReader_h

#include "vtkActiveIOModule.h" // for the export macro
#include "vtkImageReader2.h"

#include <memory> // for what it holds

class VTKACTIVEIO_EXPORT vtkActiveEXRReader : public vtkImageReader2
{
public:
  static vtkActiveEXRReader* New();
  vtkTypeMacro(vtkActiveEXRReader, vtkImageReader2);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Makes vtkImageReader2Factory return this reader for .exr files. A second call does nothing.
   */
  static void RegisterWithFactory();

  /**
   * 3 if the file begins as an EXR file does, else 0.
   */
  int CanReadFile(VTK_FILEPATH const char* name) override;
  const char* GetFileExtensions() override { return ".exr"; }
  const char* GetDescriptiveName() override;

  ///@{
  /**
   * The files of a series one by one, as an alternative to SetFileNames.
   */
  void AddFileName(VTK_FILEPATH const char* name);
  void ClearFileNames();
  ///@}

  ///@{
  /**
   * Which part of a multi-part file is read. Range: >= 0. Default: 0.
   */
  vtkSetClampMacro(Part, int, 0, VTK_INT_MAX);
  vtkGetMacro(Part, int);
  ///@}

  enum WindowType
  {
    DATA = 0,
    DISPLAY = 1
  };

  ///@{
  /**
   * Which window of the file the image covers. DATA (0): the data window, all pixels that are
   * there. DISPLAY (1): the display window; what sticks out is cropped, what is missing is 0.
   * Default: DATA.
   */
  vtkSetClampMacro(Window, int, DATA, DISPLAY);
  vtkGetMacro(Window, int);
  void SetWindowToData() { this->SetWindow(DATA); }
  void SetWindowToDisplay() { this->SetWindow(DISPLAY); }
  ///@}

  ///@{
  /**
   * Most that the pixels of an image may take [MiB], with what unpacking some of its lines, or a
   * tile, takes; a file that wants more is refused.
   * Range: >= 1. Default: 4096.
   */
  vtkSetClampMacro(MaximumMemory, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumMemory, int);
  ///@}

  ///@{
  /**
   * The parts of the file, of a series those of its first file; known after UpdateInformation(). A
   * part without a name has an empty one; its type is scanlineimage, tiledimage, deepscanline or
   * deeptile.
   */
  int GetNumberOfParts();
  const char* GetPartName(int part);
  const char* GetPartType(int part);
  ///@}

  ///@{
  /**
   * The channels of the part that is read, sorted by name; known after UpdateInformation(). Types
   * are UINT (0), HALF (1) and FLOAT (2); null or -1 for an index that there is not.
   */
  int GetNumberOfChannels();
  const char* GetChannelName(int index);
  int GetChannelType(int index);
  ///@}

  enum PixelType
  {
    UINT = 0,
    HALF = 1,
    FLOAT = 2
  };

  ///@{
  /**
   * Whether a channel is read, by its name; it need not be known yet. At first all are. A layer of
   * which not all channels are read is grouped from what is left. DisableAllChannels() before
   * EnableChannel() picks a few.
   */
  void EnableChannel(const char* name);
  void DisableChannel(const char* name);
  void EnableAllChannels();
  void DisableAllChannels();
  bool IsChannelEnabled(const char* name);
  ///@}

protected:
  vtkActiveEXRReader();
  ~vtkActiveEXRReader() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;

private:
  vtkActiveEXRReader(const vtkActiveEXRReader&) = delete;
  void operator=(const vtkActiveEXRReader&) = delete;

  struct Series;

  void NameFiles();
  void ScanFiles();
  void Publish(vtkInformation* information);
  void ReadStep(vtkInformation* information);
  int Fail(unsigned long code, const std::string& sentence, vtkInformationVector* outputs);

  int Part = 0;
  int Window = DATA;
  int MaximumMemory = 4096;
  std::unique_ptr<Series> Files;
};

#endif
