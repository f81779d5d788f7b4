"""What a mission command says beyond doubt of its values: sides of an area, stand-offs, values told
apart, places told from others, the way home.
"""
