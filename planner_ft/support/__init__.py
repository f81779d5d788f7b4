"""What every part needs: errors, files, manifests, progress. Imports nothing else of the
project.
"""
