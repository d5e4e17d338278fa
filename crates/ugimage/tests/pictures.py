"""Writes cmyk.jpg and rgb.jpg, the picture of bars.jpg in other colours of JPEG (needs Pillow 10.2)."""

from PIL import Image

bars = Image.open("bars.jpg").convert("RGB")
bars.convert("CMYK").save("cmyk.jpg", quality=95)
bars.save("rgb.jpg", quality=95, keep_rgb=True)
