"""Contents of ParaView's window of messages: each warning and each error once, in few words."""

import unittest

from paraview.simple import CreateView, Delete, Render, ResetSession, Show
from scenes import splash
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow


class Messages(unittest.TestCase):
    def setUp(self):
        ResetSession()
        self.addCleanup(vtkOutputWindow.SetInstance, vtkOutputWindow.GetInstance())
        self.window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.window)

    def show(self, surface):
        view = CreateView("RenderView")
        Show(surface, view)
        Render(view)
        Delete(view)

    def said(self):
        """Returns the messages since the last call."""
        text = self.window.GetOutput() or ""
        self.window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.window)
        return text

    def test_the_spacing_that_was_estimated_is_no_warning(self):
        surface, _ = splash(ParticleSpacing=-1)
        self.show(surface)
        text = self.said()
        self.assertEqual(text.count("a ParticleSpacing of 0.1"), 1, text)
        self.assertNotIn("Warning: In ", text)
        self.assertNotIn("ERROR", text)
        surface.Attraction = 50
        self.show(surface)
        self.assertEqual(self.said(), "", "the same after each change")

    def test_a_warning_is_shown_once_for_its_cause(self):
        surface, _ = splash(Attraction=1e-3)
        self.show(surface)
        surface.UpdatePipeline(1)
        text = self.said()
        self.assertEqual(text.count("Warning: In "), 1, text)
        surface.ComputeNormals = 0
        surface.CFL = 0.9
        surface.UpdatePipeline(1)
        self.assertEqual(self.said(), "")

    def test_an_error_is_shown_once_for_each_change(self):
        surface, _ = splash(VoxelSize=1e-9)
        self.show(surface)
        text = self.said()
        self.assertEqual(text.count("ERROR: "), 1, text)
        self.assertIn("enlarge VoxelSize", text)
        self.assertNotIn("vtkInformation", text)
        surface.VoxelSize = 2e-9
        self.show(surface)
        self.assertEqual(self.said().count("ERROR: "), 1, "of the next value")

    def test_after_an_error_the_skin_comes_back(self):
        surface, _ = splash(VoxelSize=1e-9)
        self.show(surface)
        self.assertEqual(surface.GetDataInformation().GetNumberOfPoints(), 0)
        surface.VoxelSize = 0.12
        self.said()
        self.show(surface)
        self.assertEqual(self.said(), "")
        self.assertGreater(surface.GetDataInformation().GetNumberOfPoints(), 100)


if __name__ == "__main__":
    unittest.main()
