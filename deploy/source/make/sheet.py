"""Pictures side by side, with words below each."""

from PIL import Image, ImageDraw, ImageFont

from run import PICTURES

FONT = ImageFont.truetype("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", 13)
GAP, LINE = 10, 20


def write(name, rows):
    """rows: lists of (picture file, words). Each row is as high as its highest picture."""
    cells = [[(Image.open(file).convert("RGB"), words) for file, words in row] for row in rows]
    width = max(sum(image.width + GAP for image, _ in row) for row in cells) + GAP
    heights = [max(image.height for image, _ in row) + LINE + GAP for row in cells]
    sheet = Image.new("RGB", (width, sum(heights) + GAP), "white")
    draw = ImageDraw.Draw(sheet)
    y = GAP
    for row, height in zip(cells, heights):
        x = GAP
        for image, words in row:
            assert draw.textlength(words, FONT) <= image.width + GAP, words
            sheet.paste(image, (x, y + height - LINE - GAP - image.height))
            draw.text((x + image.width / 2, y + height - LINE - GAP + 3), words, "black", FONT, anchor="ma")
            x += image.width + GAP
        y += height
    sheet.save(PICTURES / f"{name}.png", optimize=True)


def write_diagram(name, file, width):
    """A diagram of few colours, made smaller."""
    image = Image.open(file).convert("RGB")
    if image.width > width:
        image = image.resize((width, round(image.height * width / image.width)), Image.Resampling.LANCZOS)
    image.quantize(128, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(PICTURES / f"{name}.png", optimize=True)
