"""What each picture of the page shows, and how it differs from the source's: (figure, picture, words, command, difference)."""

PLOT = "metamer models plot --figures"
STILL = "metamer render deploy/source/scene.txtpb"
BLINN = "metamer render build/source/blinn.txtpb"  # by variants.py
SAVED = "-o picture.png"
REDRAWN = "deploy/report --source"

DIAGRAMS = [
    ("2-2", "fig-2-2", "Phong's model by R and by H, s = d = 0.5.", PLOT,
     "The source does not say where the light comes from; here it comes from 0°, 30° and 60° (arrows)."),
    ("2-3", "fig-2-3", "Schlick's highlight function and the cosine's.", PLOT, "As above."),
    ("2-4", "fig-2-4", "What the Fresnel term does to the highlight; at the right, with light at 80°.", PLOT,
     "The third curve at the right, the Fresnel term held at its value at normal incidence, is not in the source."),
    ("2-5", "fig-2-5", "The Fresnel term and its approximation.", PLOT,
     "The source's caption has no values; here they run from water's to silver's. A curve that is all but level, as that of f = 0.17 up to 14° "
     "at the left "
     "and 32° at the right, ends so with a jump of less than a pixel: gnuplot puts level pieces of a line on whole pixels. The numbers, in the "
     ".csv that the command "
     "writes beside the picture, rise steadily."),
    ("2-6", "fig-2-6", "Slope distributions of Beckmann and Schlick.", PLOT,
     "“Normalized” is read both ways: above by the integral E[2.2-14], below by the peak."),
    ("2-8", "fig-2-8", "Geometric attenuation, light at 65°.", PLOT,
     "The same functions; Schlick's is E[2.2-20], whose shader in the source has a misprint."),
    ("2-9", "fig-2-9", "Strauss's attenuation and Fresnel functions.", PLOT,
     "E[2.2-27] is garbled in the source; here it is as Strauss printed it, with his constants and with the source's."),
    ("2-10", "fig-2-10", "Strauss's model by smoothness and metalness.", PLOT,
     "The source's caption is lost; the parameters are chosen here."),
    ("2-11", "fig-2-11", "Oren's and Nayar's diffuse reflection and Lambert's.", PLOT, "E[2.2-29] with both projected vectors normalised."),
    ("3-3", "fig-3-3", "The matching functions of the CIE's two standard observers.", REDRAWN,
     "The source's caption says 10° and 5°: the second is the observer of 1931, for 2°. Drawn by 1 nm, which "
     "Sprague's interpolation makes of tables by 5 nm, as Metamer itself has them."),
    ("3-4", "fig-3-4", "The chromaticity diagram of the 2° observer: wavelengths in nm, the triangle of sRGB, three lights.",
     REDRAWN, "The triangle and the lights, where `metamer spectra info A D65 F11` says that they are, are additions. The curve goes from 380 to "
     "700 nm by 1 nm, interpolated as in Fig. 3-3."),
    ("4-3", "fig-4-3", "The error E[3.3-10] by the dimensions of the matrix. Rows are samples from 400 to 700 nm, columns the CIE's "
     "lights and the 15 test colours under them.", REDRAWN,
     "There are 21 lights (A, B, C, D50 to D93, E, F1 to F12), each by its mean, and 315 lit colours, so 336 columns: 75 and 300 are "
     "that many of these, picked evenly; `metamer spectra resample` samples them (make/diagrams.py). The source finds that bases of matrices "
     "with far more "
     "columns than rows represent less. So it is here from 4 functions on: 300 columns leave a larger error than 75 on as many rows, most of "
     "all on 7. "
     "Up to 3 functions the two differ by less than 3 % of the error, either way. Fewer rows leave a smaller error from 4 to 8 functions, and 7 "
     "rows throughout: "
     "7 functions leave none of it, and lines of lamps fall between samples. With up to 3 functions and from 9 on, 31 rows and 301 differ by "
     "less "
     "than 5 %, either way. Its curves are not known here."),
]

PICTURES = [
    ("E-1", "fig-e-1", "Point sampling with 301, 61, 16 and 7 samples from 400 to 700 nm: illuminant A, D65 and a fluorescent lamp, F11.",
     f"{STILL} --light '*=F11' --method point --samples 400:700:20 --point-lights samples --adapt bradford {SAVED}",
     "The same finding: smooth lights bear 16 samples, lines fall between them. Here the lights' white is adapted to the screen's, or A's "
     "pictures "
     "would be orange; what is green in the last row is what sampling makes of F11. By default Metamer takes the mean "
     "about each sample (`--point-lights better`), which the source did not."),
    ("E-2", "fig-e-2", "The sum of 301 samples under D65, in numbers of few bits: by Metamer's GL backend; with samples and sums "
     "as 16-bit floats; with each sample rounded to 8 bits, stretched so that the brightest is 255; with 8 bits as they come when a white's "
     "luminance of 1 is spread over all wavelengths.",
     f"{STILL} --backend gl --method point --samples 400:700:1 --point-lights samples --light '*=D65' {SAVED}",
     "The source's caption says “Quantization error” alone, its text that passes are kept as 32-bit floats, and neither how the card "
     "rounded. Metamer has no such formats: "
     "the rounding is done in numpy (make/quantised.py), on the spectra of its picture (`--exr spectral:400:700:1`), by the CPU and without "
     "mirrors. ΔE*uv is the largest "
     "of a pixel, between the .png and that of the sum of these spectra without rounding, not against the GL backend's picture, which the "
     "command makes."),
    ("E-3", "fig-e-3", "The linear representation with one to four basis functions, illuminant A and D65.",
     f"{STILL} --light '*=A' --method linear --bases 3 --adapt bradford {SAVED}",
     "The source finds three to be enough. Here the colours are saturated and few, and each counts: with four, both walls are still off, most "
     "of all under A, as Fig. E-4 measures."),
    ("E-4", "fig-e-4", "Four basis functions against 301 samples: ΔE*uv, illuminant A and D65.",
     "metamer compare build/source/A-linear-4.exr build/source/A-301.exr --metric deuv --scale 25 -o difference.png",
     "The source finds four enough for most scenes. They are not for this one: by the map the green wall is off by more than 25 under A and "
     "about 16 under D65, "
     "the blue ball by 13 to 17 and 10 to 13, the red wall by 10 and 8, the pebble by 10 to 12 and 7 to 8, the vase by 8 and the ring by 5 "
     "under A. Most of the plaster and the floor and, "
     "under D65, the vase are off by less than 1."),
    ("E-5", "fig-e-5", "Colour pre-filtering, and how far it is from 301 samples: D65 above, A below.",
     f"{STILL} --light '*=A' --method prefilter --adapt bradford {SAVED}",
     "The source finds it reasonably accurate for direct light. Under one kind of lamp next to nothing is lost: what is left is that 301 samples "
     "end at 400 and 700 nm. Mind the scale."),
    ("E-6", "fig-e-6", "Illuminant A without adaptation, and adapted to D65 by four transforms.",
     f"{STILL} --light '*=A' --adapt bradford {SAVED}", "CAT1 is an addition; the source shows CAT2 to CAT4."),
    ("E-7", "fig-e-7", "How far these transforms are from each other.",
     "metamer compare build/source/A-bradford.exr build/source/A-sharp.exr --metric deuv --scale 10 -o difference.png", "The white is the same "
     "by all, as it must be."),
    ("E-8", "fig-e-8", "The observers for 2° and 10°: A, then D65.",
     f"{STILL} --light '*=A' --observer cie-1964-10deg --adapt bradford {SAVED}",
     "Here each observer's white is adapted to the screen's, so that what is left is what the observers see differently in the paints."),
    ("E-9", "fig-e-9", "How far the observers are from each other.",
     "metamer compare build/source/A-2deg.exr build/source/A-10deg.exr --metric deuv --scale 10 -o difference.png", "As above."),
    ("E-10", "fig-e-10", "Rendered in RGB, and how far that is from 301 samples: D65 above, A below.",
     f"{STILL} --light '*=A' --method rgb --adapt bradford {SAVED}",
     "The source finds the two often very close. So they are under the light for which the paints' RGB was made, and not under another."),
    ("E-11", "fig-e-11", "Light of higher order under D65, by RGB, 301 samples, five basis functions and pre-filtering: "
     "above on a floor that mirrors, below with two diffuse reflections between surfaces.", 
     f"metamer render build/source/mirrors.txtpb --light '*=D65' --method linear --bases 5 --adapt bradford {SAVED}",
     "The source traced reflections alone; the lower row is an addition. All four look alike but for the green wall with five basis functions, "
     "less so below, where the basis also knows light that was reflected often."),
    ("E-12", "fig-e-12", "Every model of the registry by ray tracing and 301 samples, D65.",
     f"{BLINN} --method point --samples 400:700:1 --point-lights samples --adapt bradford {SAVED}",
     "The source has Phong's, Strauss's and Blinn's. Parameters are chosen (make/variants.py) for highlights "
     "that can be compared, and they are not alike: those of blinn_phong, phong and hall_greenberg are nearly alike and he_torrance's somewhat "
     "larger and brighter, those of blinn and "
     "cook_torrance are wider, schlick's much wider and faint, ward_phong's smeared sideways, as it is anisotropic here; strauss is darker all "
     "over, its highlight wide and faint; lambert has none."),
    ("E-13", "fig-e-13", "Every model evaluated per vertex, by the GL backend and pre-filtering, D65.",
     f"{BLINN} --backend gl --method prefilter --shading gouraud --adapt bradford {SAVED}",
     "Highlights show the triangles, as the source says of sparse tessellation. The backend has no mirrors: of the mirror ball its "
     "faint diffuse part is left, dark grey."),
    ("E-14", "fig-e-14", "Every model evaluated per pixel, by the GL backend and pre-filtering, D65.",
     f"{BLINN} --backend gl --method prefilter --shading phong --adapt bradford {SAVED}",
     "The source had room for Phong's and Blinn's, this one with a single light; here all fit, with both lights."),
    ("of section 2.3", "section-2-3", "The source describes four shadings without a picture: evaluated once a triangle, at its corners, at corners "
     "and the middles of edges, and at each sample.", f"{STILL} --shading quadratic --adapt bradford {SAVED}",
     "An addition. Quadratic shading is nearly per pixel in what it shows, with six evaluations a triangle."),
]

LEFT_OUT = ("Figs. 2-1, 2-7, 2-12, 2-13, 3-1, 3-2, 4-1, 4-2 and 4-4 are drawings that explain; Fig. E-15, metamerism, is what "
            "[the booth](../booth/contact-sheet.png) shows.")
