"""The numerical studies of TM 2003-190, sections 8 and 9, on the HALIFAX-like ship."""
