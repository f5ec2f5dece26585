#include "client/gui/app/actions.h"

namespace metamer::gui {
namespace {

constexpr Context text = Context::text, document = Context::document, picture = Context::picture;

constexpr ActionRow rows[] = {
    {"file.new", "File", "&New", "Ctrl+N"},
    {"file.open", "File", "&Open…", "Ctrl+O"},
    {"file.recent", "File", "Open &recent", ""},
    {"file.booth", "File", "Open the &demo booth", ""},
    {"file.save", "File", "&Save", "Ctrl+S", text},
    {"file.save_as", "File", "Save &as…", "Ctrl+Shift+S", text},
    {"file.save_picture", "File", "Save &picture…", "Ctrl+E", document},
    {"file.close", "File", "&Close", "Ctrl+W", text},
    {"file.quit", "File", "&Quit", "Ctrl+Q"},

    {"edit.undo", "Edit", "&Undo", "Ctrl+Z", text},
    {"edit.redo", "Edit", "&Redo", "Ctrl+Shift+Z", text},
    {"edit.find", "Edit", "&Find…", "Ctrl+F", text},
    {"edit.replace", "Edit", "R&eplace…", "Ctrl+H", text},
    {"edit.next_problem", "Edit", "&Next problem", "F8", text},
    {"edit.previous_problem", "Edit", "&Previous problem", "Shift+F8", text},
    {"edit.fix", "Edit", "&Quick fix", "Alt+Return", text},
    {"edit.complete", "Edit", "&Complete", "Ctrl+Space", text},
    {"edit.write_look", "Edit", "&Write look into scene", "Ctrl+Shift+L", document},

    {"view.live", "View", "&Live", "F5", document},
    {"view.info", "View", "Show &info", "I", picture, "", true},
    {"view.fit", "View", "&Fit", "F", picture},
    {"view.one_to_one", "View", "&1:1", "Z", picture},
    {"view.brighter", "View", "&Brighter by a third of a stop", "E", picture},
    {"view.darker", "View", "&Darker by a third of a stop", "Shift+E", picture},
    {"view.gamut", "View", "Out of &gamut", "G", picture, "", true},
    {"view.wipe", "View", "&Wipe", "W", picture, "", true},
    {"view.next_slot", "View", "&Next picture slot", "J", picture},
    {"view.previous_slot", "View", "&Previous picture slot", "Shift+J", picture},
    {"view.numbers", "View", "N&umbers in pixels", "N", picture, "", true},
    {"view.full_screen", "View", "Full &screen", "F11", Context::always, "", true},
    {"view.display.system", "View/Display profile", "From the &system", ""},
    {"view.display.file", "View/Display profile", "Of a &file…", ""},
    {"view.device.gl", "View/Device", "&GL", "", document, "device"},
    {"view.device.cpu", "View/Device", "&CPU", "", document, "device"},
    {"view.device.other", "View/Device", "&Other device", "D", picture},
    {"view.lighting.phong", "View/Lighting", "Per &pixel", "", document, "lighting"},
    {"view.lighting.gouraud", "View/Lighting", "Per &vertex", "", document, "lighting"},
    {"view.lighting.constant", "View/Lighting", "Per &triangle", "", document, "lighting"},
    {"view.lighting.quadratic", "View/Lighting", "&Quadratic", "", document, "lighting"},
    {"view.lighting.next", "View/Lighting", "&Next lighting", "L", picture},
    {"view.orbit.left", "View/Camera", "Orbit &left", "Left", picture},
    {"view.orbit.right", "View/Camera", "Orbit &right", "Right", picture},
    {"view.orbit.up", "View/Camera", "Orbit &up", "Up", picture},
    {"view.orbit.down", "View/Camera", "Orbit &down", "Down", picture},
    {"view.pan.left", "View/Camera", "Pan left", "Shift+Left", picture},
    {"view.pan.right", "View/Camera", "Pan right", "Shift+Right", picture},
    {"view.pan.up", "View/Camera", "Pan up", "Shift+Up", picture},
    {"view.pan.down", "View/Camera", "Pan down", "Shift+Down", picture},
    {"view.dolly.in", "View/Camera", "Dolly &in", "+; =", picture},
    {"view.dolly.out", "View/Camera", "Dolly &out", "-", picture},
    {"view.home", "View/Camera", "&Home", "Home", picture},

    {"light.look.1", "Light", "Look &1", "1", picture},
    {"light.look.2", "Light", "Look &2", "2", picture},
    {"light.look.3", "Light", "Look &3", "3", picture},
    {"light.look.4", "Light", "Look &4", "4", picture},
    {"light.look.5", "Light", "Look &5", "5", picture},
    {"light.look.6", "Light", "Look &6", "6", picture},
    {"light.look.7", "Light", "Look &7", "7", picture},
    {"light.look.8", "Light", "Look &8", "8", picture},
    {"light.look.9", "Light", "Look &9", "9", picture},
    {"light.look.none", "Light", "The scene's &own", "0", picture},
    {"light.look.keep", "Light", "&Keep as a look…", "", document},
    {"light.all", "Light", "&All lights…", "A", picture},
    {"light.observer.2", "Light/Observer", "&2°, CIE 1931", "", document, "observer"},
    {"light.observer.10", "Light/Observer", "&10°, CIE 1964", "", document, "observer"},
    {"light.adaptation.none", "Light/Adaptation", "&Not adapted", "", document, "adaptation"},
    {"light.adaptation.von_kries", "Light/Adaptation", "&Von Kries", "", document, "adaptation"},
    {"light.adaptation.bradford", "Light/Adaptation", "&Bradford", "", document, "adaptation"},
    {"light.adaptation.sharp", "Light/Adaptation", "&Sharp", "", document, "adaptation"},
    {"light.adaptation.cmccat2000", "Light/Adaptation", "&CMCCAT2000", "", document, "adaptation"},
    {"light.paint", "Light", "Swap &paint…", "T", picture},
    {"light.pin", "Light", "Pi&n", "P", picture},
    {"light.rgb", "Light", "Hold for RG&B", "R", picture, "", true},
    {"light.rgb_map", "Light", "Map of the RGB &difference", "Shift+R", picture},

    {"render.check", "Render", "&Check", "F7", document},
    {"render.render", "Render", "&Render", "F9", document},
    {"render.settings", "Render", "&Settings…", "Ctrl+T", document},
    {"render.explain", "Render", "&Explain methods", "Ctrl+M", document},
    {"render.pause", "Render", "&Pause", "Space", picture},
    {"render.cancel", "Render", "C&ancel", "Esc", picture},
    {"render.measure", "Render", "&Measure all methods", "", document},

    {"spectra.manager", "Spectra", "&Manager…", "Ctrl+Shift+M"},
    {"spectra.metamer", "Spectra", "Make a m&etamer…", ""},

    {"compare.pictures", "Compare", "&Pictures…", "Ctrl+Shift+C"},
    {"compare.sheet", "Compare", "&Metamerism sheet…", "Ctrl+Shift+T", document},

    {"window.next_pane", "Window", "&Next pane", "F6"},
    {"window.previous_pane", "Window", "&Previous pane", "Shift+F6"},
    {"window.reset", "Window", "&Reset layout", ""},

    {"help.palette", "Help", "&Commands…", "Ctrl+Shift+P"},
    {"help.keys", "Help", "&Keys", "F1"},
    {"help.models", "Help", "&Models", ""},
    {"help.server", "Help", "&Server…", ""},
    {"help.about", "Help", "&About", ""},
};

}  // namespace

std::span<const ActionRow> action_table() { return rows; }

}  // namespace metamer::gui
