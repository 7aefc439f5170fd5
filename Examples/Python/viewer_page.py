"""Layout of the page of viewer.py: sliders and the history on its left, picture and time on its
right."""

import math
import re
from contextlib import contextmanager

from active_implicit_surfaces.properties import find
from trame.ui.vuetify3 import SinglePageWithDrawerLayout
from trame.widgets import html
from trame.widgets import vuetify3 as v3

SAVED = (".vtp", ".obj", ".vdb")
SKIN, MARK, PAST, INK = "#2f7fb5", "#e57c2c", "#c4c4c4", "#666"
TURN = "$event.buttons && trigger('turn', [$event.movementX, $event.movementY])"


def build_page(server, sliders, times):
    """Builds the page from the server's state; the page calls the triggers turn, zoom and save."""
    server.state.trame__title = "Active implicit surfaces"
    with SinglePageWithDrawerLayout(server) as layout:
        layout.title.set_text("Active implicit surfaces")
        layout.footer.hide()
        layout.toolbar.density = "compact"
        with layout.toolbar:
            v3.VSpacer()
            for suffix in SAVED:
                _add_save_button(suffix)
        with layout.drawer as drawer:
            drawer.width, drawer.permanent = 340, True
            for name, (least, greatest, _, _) in sliders.items():
                _add_slider(name, least, greatest)
            html.Div("Volume [length³] over time", classes="px-4 pt-2 text-body-2")
            html.Div(v_html=("history",), classes="px-4 history")
        with layout.content:
            _add_view(len(times))


def _add_slider(name, least, greatest):
    own = find(name)
    unit = re.search(r"\[([^]]+)\]", own.comment)[1].replace("^2", "²")
    label = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", own.name).capitalize()
    about = own.summary.partition(" (default")[0] + "."
    with html.Div(classes="px-4 pt-3"):
        with _tooltip(about, "end"), html.Div(v_bind="props", classes="d-flex text-body-2"):
            html.Span(f"{label} [{unit}]")
            v3.VSpacer()
            html.Span(f"{{{{ values.{name} }}}}", classes=f"font-weight-medium {name}")
        v3.VSlider(
            v_model=(name,),
            min=least,
            max=greatest,
            step=(greatest - least) / 100 if least else 0.01,
            classes=f"slider-{name}",
            color="primary",
            density="compact",
            hide_details=True,
        )


def _add_save_button(suffix):
    mime = "application/octet-stream"
    with _tooltip(f"Save the skin of this frame as {suffix}", "bottom"):
        v3.VBtn(
            suffix,
            v_bind="props",
            prepend_icon="mdi-download",
            classes=f"text-none save-{suffix[1:]}",
            disabled=("!is_made",),
            click=f"utils.download('skin_' + step + '{suffix}', trigger('save', ['{suffix}']), "
            f"'{mime}')",
        )


@contextmanager
def _tooltip(text, location):
    """Shows text beside the elements created in the context, which have to bind `props`."""
    bubble = v3.VTooltip(text=text, max_width=340, location=location)
    with bubble, v3.Template(v_slot_activator="{ props }"):
        yield


def _add_view(count):
    style = "height: 100%; background: #f5f5f2"
    with v3.VContainer(fluid=True, classes="pa-0 d-flex flex-column", style=style):
        with html.Div(style="flex: 1; min-height: 0; position: relative"):
            v3.VAlert(
                "{{ note }}",
                v_if=("note",),
                closable=True,
                click_close="note = ''",
                type="info",
                density="compact",
                classes="note text-body-2",
                style="position: absolute; top: 8px; left: 8px; right: 8px; z-index: 1",
            )
            html.Img(
                src=("picture", ""),
                classes=("'picture ' + drawn",),
                draggable="false",
                style="width: 100%; height: 100%; object-fit: contain; cursor: grab",
                mousemove=TURN,
                wheel="trigger('zoom', [$event.deltaY])",
                __events=["mousemove", ("wheel", "wheel.prevent")],
            )
        with html.Div(classes="d-flex align-center px-4 pb-2"):
            v3.VBtn(
                icon=("playing ? 'mdi-pause' : 'mdi-play'",),
                click="playing = !playing",
                color="primary",
                density="comfortable",
                classes="play mr-4",
            )
            with html.Div(style="flex: 1"):
                v3.VSlider(
                    v_model=("step",),
                    min=0,
                    max=count - 1,
                    step=1,
                    classes="time",
                    color="primary",
                    hide_details=True,
                )
                v3.VProgressLinear(
                    model_value=(f"100 * made / {count}",), height=2, color="grey", classes="made"
                )
            html.Div(
                f"frame {{{{ step + 1 }}}} of {count}, time {{{{ time }}}}",
                classes="frame ml-4 text-body-2",
                style="width: 13em",
            )


def draw_history(points, before, times, now):
    """Returns an SVG of the volume over time; the curve of the previous motion is gray."""
    top = _round_up(max((volume for _, volume in points + before), default=1.0))

    def across(time):
        return f"{4 + 280 * (time - times[0]) / (times[-1] - times[0]):.1f}"

    def line(path, color):
        spots = " ".join(f"{across(time)},{100 - 90 * volume / top:.1f}" for time, volume in path)
        return f'<polyline points="{spots}" fill="none" stroke="{color}" stroke-width="1.5"/>'

    return (
        f'<svg viewBox="0 0 288 118" width="100%" font-size="11" fill="{INK}">'
        f'<path d="M4 10V100H284" fill="none" stroke="{PAST}"/>'
        f'<path d="M{across(now)} 10V100" stroke="{MARK}"/>'
        f"{line(before, PAST)}{line(points, SKIN)}"
        f'<text x="8" y="16">{top:g}</text><text x="4" y="114">{times[0]:.3g}</text>'
        f'<text x="284" y="114" text-anchor="end">{times[-1]:.3g} [time]</text></svg>'
    )


def _round_up(number):
    """Rounds up to one digit."""
    if number <= 0:
        return 1.0
    place = 10.0 ** math.floor(math.log10(number))
    return math.ceil(number / place) * place
