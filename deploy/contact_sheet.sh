# Lays the six pictures out on one labelled sheet. Sourced by demo, whose variables it uses.

make_contact_sheet() {
  local font=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf
  local width=960 height=640 left=250 top=110 gap=12 bottom=90
  local names=("D65, daylight" "A, tungsten" "F11, fluorescent")
  local words=("whole spectra" "3 numbers")
  local white=color=0.95,0.95,0.95 grey=color=0.65,0.65,0.65
  local sheet_width=$((left + 3 * (width + gap))) sheet_height=$((top + 2 * (height + gap) + bottom))
  local row column x y

  local -a steps=(--create "${sheet_width}x${sheet_height}" 3
    "--fill:color=0.10,0.10,0.10" "${sheet_width}x${sheet_height}+0+0")
  for row in 0 1; do
    y=$((top + row * (height + gap)))
    steps+=("--text:x=$((left / 2)):y=$((y + height / 2)):size=60:xalign=center:font=$font:$white"
      "${methods[row]}"
      "--text:x=$((left / 2)):y=$((y + height / 2 + 46)):size=29:xalign=center:font=$font:$grey"
      "${words[row]}")
    for column in 0 1 2; do
      x=$((left + column * (width + gap)))
      steps+=("$out/booth-${lights[column]}-${methods[row]}.png" --ch R,G,B --swap --paste "+$x+$y")
    done
  done
  for column in 0 1 2; do
    x=$((left + column * (width + gap) + width / 2))
    steps+=("--text:x=$x:y=80:size=60:xalign=center:font=$font:$white" "${names[column]}")
  done
  steps+=("--text:x=$left:y=$((sheet_height - 32)):size=42:font=$font:$grey"
    "The chequer and the two swatches: paints that match in daylight and part under other lights. Three numbers cannot see it.")

  oiiotool --nosoftwareattrib "${steps[@]}" --eraseattrib ".*" -d uint8 -o "$out/contact-sheet.png"
  oiiotool --nosoftwareattrib "$out/contact-sheet.png" --resize 1536x0 -d uint8 -o "$out/contact-sheet-small.png"
}
